// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "halfspace/core/check.h"
#include "halfspace/render/particles.h"
#include "halfspace/scene/keys.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxLine = 1000;  // bytes
constexpr const char* kRow = "expected x,y,z[,radius[,r,g,b]]";

std::string_view trimmed(std::string_view s) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

// The numbers of one line.
struct Row {
  std::array<double, 7> number{};
  std::size_t count = 0;
};

class RowReader {
 public:
  explicit RowReader(const std::filesystem::path& path) : path_(path) {}

  Row read(std::string_view line, int line_number) {
    line_number_ = line_number;
    Row row;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t comma = std::min(line.find(',', begin), line.size());
      if (row.count == row.number.size()) fail("has more than 7 numbers");
      row.number[row.count++] = number(trimmed(line.substr(begin, comma - begin)));
      begin = comma + 1;
    }
    if (row.count != 3 && row.count != 4 && row.count != 7) fail(fmt::format("has {} number{}", row.count, row.count == 1 ? "" : "s"));
    if (row.count > 3 && !(row.number[3] >= kMinRadius && row.number[3] <= kMaxRadius))
      fail("the radius is " + number_text(row.number[3]), "expected one from 1e-6 to 1e6");
    for (std::size_t k = 4; k < row.count; ++k) {
      if (!(row.number[k] >= 0.0 && row.number[k] <= kMaxCount))
        fail("a color value is " + number_text(row.number[k]), "expected one from 0 to 1e9");
    }
    return row;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& expected = kRow) const {
    throw InputError(fmt::format("{}:{}: {}; {}", path_.string(), line_number_, what, expected));
  }

 private:
  static constexpr double kMinRadius = 1e-6, kMaxRadius = 1e6;

  double number(std::string_view text) const {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) fail(quoted(text) + " is not a number");
    if (!(std::fabs(x) <= kMaxCount)) fail(quoted(text) + " is out of range", "expected numbers from -1e9 to 1e9");
    return x;
  }

  static std::string quoted(std::string_view text) {
    std::string s(1, '\'');
    for (const char c : text.substr(0, 40)) s.push_back(static_cast<unsigned char>(c) < 32 ? ' ' : c);
    s.push_back('\'');
    return s;
  }

  const std::filesystem::path& path_;
  int line_number_ = 0;
};

}  // namespace

Particles read_particles(const std::filesystem::path& path, const ParticlesDescription& p) {
  const auto fail = [&](const std::string& what) { throw InputError(path.string() + ": " + what); };
  std::error_code none;
  if (!std::filesystem::exists(path, none)) fail("no such file; expected a .csv file of spheres");
  if (!std::filesystem::is_regular_file(path, none)) fail("is not a regular file; expected a .csv file of spheres");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::string("cannot be read (") + std::strerror(errno) + "); expected a .csv file of spheres");
  RowReader reader(path);
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    if (text.size() > kMaxLine) fail(fmt::format("line {} is longer than 1000 bytes; {}", number, kRow));
    rows.push_back(reader.read(text, number));
    if (rows.size() > static_cast<std::size_t>(kMaxParticles)) reader.fail("is row 1000001", "expected at most 1000000 rows");
  }
  if (rows.empty()) fail(std::string("has no row; ") + kRow);

  ParticlesDescription as_many = p;
  as_many.count = static_cast<int>(rows.size());
  const double radius = particle_radius(as_many);
  Particles out;
  for (const Row& r : rows) {
    out.centers_ws.emplace_back(r.number[0], r.number[1], r.number[2]);
    out.radii.push_back(static_cast<float>(r.count > 3 ? r.number[3] : radius));
    out.colors.push_back(r.count > 4 ? glm::vec3(r.number[4], r.number[5], r.number[6]) : glm::vec3(1.0f));
  }
  return out;
}

}  // namespace halfspace::HS_LANES
