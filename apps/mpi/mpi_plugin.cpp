// SPDX-License-Identifier: Apache-2.0
#include "mpi/mpi_plugin.h"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "mpi/rank_threads.h"

namespace halfspace {

namespace {

enum Tag : int { kRequest, kReply, kResult };

using Request = std::array<int64_t, 2>;  // what the rank has done, and kept
using Reply = std::array<int64_t, 3>;    // the number, and what all other ranks have done and kept

// Rank 0 has a second thread, which answers the other ranks.
struct Queue {
  int rank = 0, ranks = 1;
  std::thread server;
  std::vector<std::string> results;  // of the other ranks; written by the server
  std::mutex mutex;
  int total = 0;                      // set before the server starts
  int next = 0;                       // on rank 0, under the mutex
  std::vector<PictureCounts> counts;  // likewise, of each rank when it last asked
  PictureCounts others;               // on the other ranks, from the last reply
};
Queue queue;

// Returns what all ranks but one had done. The caller holds the mutex.
PictureCounts others_of(int rank) {
  PictureCounts sum;
  for (int r = 0; r < queue.ranks; ++r) {
    const PictureCounts& counts = queue.counts[static_cast<std::size_t>(r)];
    if (r != rank) sum = {sum.done + counts.done, sum.kept + counts.kept};
  }
  return sum;
}

// Answers a rank, on rank 0.
Reply answer(int rank, const PictureCounts& counts) {
  const std::lock_guard lock(queue.mutex);
  queue.counts[static_cast<std::size_t>(rank)] = counts;
  const PictureCounts others = others_of(rank);
  return {queue.next < queue.total ? queue.next++ : -1, others.done, others.kept};
}

// Waits without using the CPU, which MPI's own functions would do: the threads that render need it.
MPI_Status wait_for_message() {
  using namespace std::chrono_literals;
  MPI_Status status;
  int found = 0;
  for (;;) {
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &status);
    if (found != 0) return status;
    std::this_thread::sleep_for(500us);
  }
}

// Answers requests until the results of all other ranks have arrived.
void serve() {
  while (static_cast<int>(queue.results.size()) < queue.ranks - 1) {
    const MPI_Status status = wait_for_message();
    if (status.MPI_TAG == kRequest) {
      Request request{};
      MPI_Recv(request.data(), request.size(), MPI_INT64_T, status.MPI_SOURCE, kRequest, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      const Reply reply = answer(status.MPI_SOURCE, {request[0], request[1]});
      MPI_Send(reply.data(), reply.size(), MPI_INT64_T, status.MPI_SOURCE, kReply, MPI_COMM_WORLD);
      continue;
    }
    int bytes = 0;
    MPI_Get_count(&status, MPI_CHAR, &bytes);
    std::string text(static_cast<std::size_t>(bytes), '\0');
    MPI_Recv(text.data(), bytes, MPI_CHAR, status.MPI_SOURCE, kResult, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    queue.results.push_back(std::move(text));
  }
}

NodeRanks node_ranks() {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  std::array<unsigned char, sizeof(cpu_set_t)> own{}, all{};
  std::memcpy(own.data(), &set, sizeof set);
  MPI_Allreduce(own.data(), all.data(), static_cast<int>(all.size()), MPI_UNSIGNED_CHAR, MPI_BOR, node);
  cpu_set_t together;
  std::memcpy(&together, all.data(), sizeof together);
  NodeRanks ranks{.own = CPU_COUNT(&set), .sum = 0, .all = CPU_COUNT(&together)};
  MPI_Allreduce(&ranks.own, &ranks.sum, 1, MPI_INT, MPI_SUM, node);
  MPI_Comm_size(node, &ranks.ranks);
  MPI_Comm_free(&node);
  return ranks;
}

MpiPlace start(int quota) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &queue.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &queue.ranks);
  const NodeRanks node = node_ranks();
  return {queue.rank, threads_of_rank(node, quota), node.own};
}

void begin(int total) {
  queue.total = total;
  queue.counts.resize(static_cast<std::size_t>(queue.ranks));
  if (queue.rank == 0 && queue.ranks > 1) queue.server = std::thread(serve);
}

int next(PictureCounts own) {
  if (queue.rank == 0) return static_cast<int>(answer(0, own)[0]);
  const Request request{own.done, own.kept};
  Reply reply{};
  MPI_Send(request.data(), request.size(), MPI_INT64_T, 0, kRequest, MPI_COMM_WORLD);
  MPI_Recv(reply.data(), reply.size(), MPI_INT64_T, 0, kReply, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  queue.others = {reply[1], reply[2]};
  return static_cast<int>(reply[0]);
}

PictureCounts others() {
  if (queue.rank != 0) return queue.others;
  const std::lock_guard lock(queue.mutex);
  return others_of(0);
}

void finish(const char* text, std::size_t size, void (*receive)(void*, const char*, std::size_t), void* context) {
  if (queue.rank != 0) {
    MPI_Send(text, static_cast<int>(size), MPI_CHAR, 0, kResult, MPI_COMM_WORLD);
    return;
  }
  if (queue.server.joinable()) queue.server.join();
  for (const std::string& result : queue.results) receive(context, result.data(), result.size());
}

void end() { MPI_Finalize(); }

void abort(int exit_code) { MPI_Abort(MPI_COMM_WORLD, exit_code); }

}  // namespace

}  // namespace halfspace

extern "C" __attribute__((visibility("default"))) const halfspace::MpiFunctions halfspace_mpi_functions{
    halfspace::start, halfspace::begin, halfspace::next, halfspace::others, halfspace::finish, halfspace::end, halfspace::abort};
