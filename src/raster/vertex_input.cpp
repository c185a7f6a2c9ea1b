// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/vertex_input.h"

#include <limits>

namespace halfspace::HS_LANES {

namespace {

bool can_read_as(ComponentType type, ReadAs as) {
  const bool has_integers = type >= ComponentType::uint8 && !is_packed(type);
  switch (as) {
    case ReadAs::floats: return true;
    case ReadAs::normalized: return has_integers || is_packed(type);
    case ReadAs::integers: return has_integers;
    case ReadAs::halves: return type == ComponentType::float16;
  }
  return false;
}

// Checks what a stream that was made by hand can get wrong.
void check_stream(const VertexStream& s) {
  HS_CHECK_OP(s.stride, >=, 0, "make_vertex_view: the stride of a stream is negative; expected at least 0");
  HS_CHECK_OP(s.components, >=, 0, "make_vertex_view: the number of components of a stream is negative; expected at least 0");
  HS_CHECK(s.data != nullptr || s.count == 0 || s.components == 0, "make_vertex_view: a stream has rows but no data; expected an array");
  HS_CHECK(!is_packed(s.type) || s.components == 4,
           "make_vertex_view: a stream of packed numbers has another number of components; expected 4");
  HS_CHECK(can_read_as(s.type, s.read_as),
           "make_vertex_view: the type of a stream cannot be read in this way; expected floats, integers for normalized and integers, or "
           "float16 for halves");
  HS_CHECK(s.missing == 0 || (s.missing > 0 && s.missing < s.components && s.components <= 4 && !is_packed(s.type)),
           "make_vertex_view: the number of missing components of a stream is wrong; expected 0, or fewer than its 2 to 4 components");
  HS_CHECK(!s.bgra || (s.components == 4 && s.missing == 0 && s.read_as == ReadAs::normalized &&
                       (s.type == ComponentType::uint8 || is_packed(s.type))),
           "make_vertex_view: a stream of another kind is read as BGRA; expected four normalized bytes, or packed numbers");
  // gather uses 32-bit indices. The division avoids an overflow of the product.
  HS_CHECK_OP(s.count, <=, ((std::size_t{1} << 31) - 1) / std::max<std::size_t>(static_cast<std::size_t>(s.stride) / sizeof(float), 1),
              "make_vertex_view: a stream is too long; expected fewer than 2^31 rows and 2^33 bytes");
}

}  // namespace

namespace detail {

VertexView bind_streams(std::span<const VertexStream> streams) {
  const auto per_vertex = std::ranges::find(streams, 0u, &VertexStream::divisor);
  HS_CHECK(per_vertex != streams.end(),
           "make_vertex_view: no stream has one row per vertex; expected such a stream, or the number of vertices as an argument");
  return bind_streams(streams, per_vertex->count);
}

VertexView bind_streams(std::span<const VertexStream> streams, std::size_t vertex_count) {
  HS_CHECK_OP(streams.size(), <=, kMaxStreams, "make_vertex_view: too many streams; expected at most 16");
  VertexView v{.streams = {}, .stream_count = static_cast<int>(streams.size()), .vertex_count = vertex_count};
  std::ranges::copy(streams, v.streams.begin());
  for (const VertexStream& s : streams) {
    check_stream(s);
    HS_CHECK_OP(s.components, <=, kMaxStreamComponents - v.components,
                "make_vertex_view: the streams have too many components; expected at most 64 in all streams");
    for (int i = v.components; s.read_as == ReadAs::integers && i < v.components + s.components; ++i)
      v.integer_components |= uint64_t{1} << i;
    v.components += s.components;
    v.needs_conversion |= !is_read_in_place(s);
    if (s.divisor != 0) {
      v.has_instance_streams = true;
    } else {
      HS_CHECK_OP(s.count, ==, vertex_count, "make_vertex_view: the streams have different lengths; expected one row per vertex in each");
    }
  }
  return v;
}

}  // namespace detail

Indices Indices::sequential(std::size_t vertex_count) {
  HS_CHECK_OP(vertex_count, <, std::size_t{1} << 32, "Indices: too many vertices; expected fewer than 2^32");
  Indices i;
  i.size_ = vertex_count;
  i.end_ = static_cast<uint32_t>(vertex_count);
  return i;
}

Indices::Indices(std::span<const uint32_t> list, std::size_t vertex_count, PrimitiveRestart restart)
    : wide_(list.data()), size_(list.size()), restart_(restart) {
  scan(list, vertex_count);
}

Indices::Indices(std::span<const uint16_t> list, std::size_t vertex_count, PrimitiveRestart restart)
    : narrow_(list.data()), size_(list.size()), restart_(restart) {
  scan(list, vertex_count);
}

Indices::Indices(std::span<const uint8_t> list, std::size_t vertex_count, PrimitiveRestart restart)
    : bytes_(list.data()), size_(list.size()), restart_(restart) {
  scan(list, vertex_count);
}

Indices Indices::range(std::size_t first, std::size_t count) const {
  HS_CHECK_OP(first, <=, size_, "Indices: the first index of a range is too large; expected at most the number of indices");
  HS_CHECK_OP(count, <=, size_ - first, "Indices: a range has too many indices; expected that it ends with the list or before");
  if (wide_ != nullptr) return {std::span(wide_ + first, count), end_, restart_};
  if (narrow_ != nullptr) return {std::span(narrow_ + first, count), end_, restart_};
  if (bytes_ != nullptr) return {std::span(bytes_ + first, count), end_, restart_};
  Indices i;
  i.size_ = count;
  i.first_ = first_ + static_cast<uint32_t>(first);
  i.end_ = i.first_ + static_cast<uint32_t>(count);
  return i;
}

template <class T>
void Indices::scan(std::span<const T> list, std::size_t vertex_count) {
  const auto is_restart = [this](T i) { return restart_.ends_at(i); };
  T low = std::numeric_limits<T>::max(), high = 0;
  for (std::size_t place = 0; place < list.size(); ++place) {
    if (is_restart(list[place])) {
      restarts_.push_back(static_cast<uint32_t>(place));
      continue;
    }
    low = std::min(low, list[place]);
    high = std::max(high, list[place]);
  }
  if (restarts_.size() == list.size()) return;
  HS_CHECK_OP(high, <, vertex_count, "Indices: an index is too large; expected less than the number of vertices");
  first_ = low;
  end_ = static_cast<uint32_t>(high) + 1;
  std::vector<bool> seen(end_ - first_);
  std::size_t distinct = 0;
  for (const T i : list) {
    if (is_restart(i)) continue;
    if (!seen[i - first_]) ++distinct;
    seen[i - first_] = true;
  }
  if (distinct == seen.size()) return;
  used_.reserve(distinct);
  for (uint32_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) used_.push_back(first_ + i);
  }
}

std::span<const VertexStream> at_instance(const VertexStreams& vertices, uint32_t instance, StreamStorage& storage) {
  if (!vertices.has_instance_streams) return vertices.streams;
  std::copy(vertices.streams.begin(), vertices.streams.end(), storage.begin());
  const std::span<VertexStream> moved(storage.data(), vertices.streams.size());
  for (VertexStream& s : moved) {
    if (s.divisor == 0) continue;
    s.data += static_cast<std::size_t>(instance / s.divisor) * static_cast<std::size_t>(s.stride);
    s.stride = 0;
  }
  return moved;
}

void read_vertex(std::span<const VertexStream> streams, std::size_t vertex, std::span<float> out) {
  for (const VertexStream& s : streams) {
    read_row(s, vertex, out.data());
    out = out.subspan(static_cast<std::size_t>(s.components));
  }
}

}  // namespace halfspace::HS_LANES
