// SPDX-License-Identifier: Apache-2.0
#include "mpi/mpi_plugin.h"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace halfspace {

namespace {

enum Tag : int { kRequest, kReply, kResult };

struct Queue {
  int rank = 0, ranks = 1, total = 0;
  std::atomic<int> next = 0;
  std::atomic<int> others_done = 0;
  std::thread server;                // on rank 0
  std::vector<std::string> results;  // of the other ranks; written by the server
};
Queue queue;

int take_next() {
  const int number = queue.next++;
  return number < queue.total ? number : -1;
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
  std::vector<bool> has_work(static_cast<std::size_t>(queue.ranks), false);
  while (static_cast<int>(queue.results.size()) < queue.ranks - 1) {
    const MPI_Status status = wait_for_message();
    int bytes = 0;
    MPI_Get_count(&status, MPI_CHAR, &bytes);
    std::string text(static_cast<std::size_t>(bytes), '\0');
    MPI_Recv(text.data(), bytes, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (status.MPI_TAG == kResult) {
      queue.results.push_back(std::move(text));
      continue;
    }
    const auto source = static_cast<std::size_t>(status.MPI_SOURCE);
    if (has_work[source]) ++queue.others_done;
    const int number = take_next();
    has_work[source] = number >= 0;
    MPI_Send(&number, 1, MPI_INT, status.MPI_SOURCE, kReply, MPI_COMM_WORLD);
  }
}

// The CPUs of this process and, as bits, of all ranks of its node.
struct NodeCpus {
  int own = 1, sum = 1, all = 1;
};

NodeCpus node_cpus() {
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
  NodeCpus cpus{.own = CPU_COUNT(&set), .sum = 0, .all = CPU_COUNT(&together)};
  MPI_Allreduce(&cpus.own, &cpus.sum, 1, MPI_INT, MPI_SUM, node);
  MPI_Comm_free(&node);
  return cpus;
}

MpiPlace start(int cpu_limit) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &queue.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &queue.ranks);
  const NodeCpus cpus = node_cpus();
  // Ranks that are bound to CPUs of their own use them; ranks that may use the same CPUs share them.
  const int share = std::min(cpu_limit, cpus.own) * cpus.all / std::max(cpus.sum, 1);
  return {queue.rank, std::max(share, 1), cpus.own};
}

void begin(int total) {
  queue.total = total;
  if (queue.rank == 0 && queue.ranks > 1) queue.server = std::thread(serve);
}

int next() {
  if (queue.rank == 0) return take_next();
  int number = -1;
  MPI_Send(nullptr, 0, MPI_CHAR, 0, kRequest, MPI_COMM_WORLD);
  MPI_Recv(&number, 1, MPI_INT, 0, kReply, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return number;
}

int others_done() { return queue.others_done; }

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
    halfspace::start, halfspace::begin, halfspace::next, halfspace::others_done, halfspace::finish, halfspace::end, halfspace::abort};
