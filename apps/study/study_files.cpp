// SPDX-License-Identifier: Apache-2.0
#include "study/study_files.h"

#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"

namespace halfspace {

namespace {

using OrderedJson = nlohmann::ordered_json;

void write_text(const std::filesystem::path& path, const std::string& text) { write_file(path, std::as_bytes(std::span(text))); }

std::string csv_of(const Study& study, const std::vector<bool>& front) {
  const auto names = [](const std::vector<Quantity>& quantities) {
    std::string text;
    for (const Quantity& q : quantities) text += fmt::format(",{}", q.name);
    return text;
  };
  const auto values = [](const std::vector<Quantity>& quantities) {
    std::string text;
    for (const Quantity& q : quantities) text += fmt::format(",{:.6g}", q.value);
    return text;
  };
  const Variant& first = study.variants.front();
  std::string text =
      fmt::format("study,variant,group{},error{},ms_median,ms_low,ms_high,runs,pareto\n", names(first.parameters), names(first.measures));
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    const Variant& v = study.variants[i];
    HS_CHECK(v.parameters.size() == first.parameters.size() && v.measures.size() == first.measures.size(),
             "study: the variants report different parameters or measures; expected the same for all");
    text += fmt::format("{},\"{}\",\"{}\"{},{:.6g}{},{:.6g},{:.6g},{:.6g},{},{}\n", study.name, v.name, v.group, values(v.parameters),
                        v.error, values(v.measures), v.time.median_ms, v.time.low_ms, v.time.high_ms, v.time.runs, front[i] ? 1 : 0);
  }
  return text;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

OrderedJson to_json(const std::vector<Quantity>& numbers) {
  OrderedJson json = OrderedJson::object();
  for (const Quantity& n : numbers) json[n.name] = n.value;
  return json;
}

// Writes a picture and returns its file name. Returns null for an empty picture.
OrderedJson write_picture(const Image<glm::u8vec4>& picture, const std::string& name, const std::filesystem::path& folder) {
  if (picture.empty()) return nullptr;
  write_png(folder / (name + ".png"), picture);
  return name + ".png";
}

OrderedJson json_of(const Study& study, const std::vector<bool>& front, const RunFacts& facts, const std::filesystem::path& folder) {
  OrderedJson json = {{"study", study.name},
                      {"title", study.title},
                      {"setting", study.setting},
                      {"error_name", study.error_name},
                      {"time_name", study.time_name},
                      {"run",
                       {{"command", facts.command},
                        {"date", today()},
                        {"version", facts.version},
                        {"processor", processor()},
                        {"cores", Workers::cores()},
                        {"threads", facts.threads},
                        {"quick", facts.quick}}},
                      {"truth",
                       {{"method", study.truth.method},
                        {"error", study.truth.error},
                        {"error_method", study.truth.error_method},
                        {"picture", write_picture(study.truth.picture, study.name + "-truth", folder)}}}};
  OrderedJson& rows = json["variants"] = OrderedJson::array();
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    const Variant& v = study.variants[i];
    const std::string file = study.name + "-" + file_word(v.name);
    rows.push_back({{"name", v.name},
                    {"group", v.group},
                    {"parameters", to_json(v.parameters)},
                    {"error", v.error},
                    {"measures", to_json(v.measures)},
                    {"ms", {{"median", v.time.median_ms}, {"low", v.time.low_ms}, {"high", v.time.high_ms}, {"runs", v.time.runs}}},
                    {"pareto", static_cast<bool>(front[i])},
                    {"picture", write_picture(v.picture, file, folder)},
                    {"difference", write_picture(v.difference, file + "-difference", folder)}});
  }
  return json;
}

}  // namespace

std::string file_word(std::string_view name) {
  std::string word;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (letter) {
      word += c;
    } else if (c >= 'A' && c <= 'Z') {
      word += static_cast<char>(c - 'A' + 'a');
    } else if (!word.empty() && word.back() != '-') {
      word += '-';
    }
  }
  while (word.ends_with('-')) word.pop_back();
  return word;
}

void write_study(const Study& study, const RunFacts& facts, const std::filesystem::path& folder) {
  const std::vector<bool> front = pareto_front(study.variants, study.truth.error);
  write_text(folder / (study.name + ".csv"), csv_of(study, front));
  write_text(folder / (study.name + ".json"), json_of(study, front, facts, folder).dump(2) + "\n");
}

}  // namespace halfspace
