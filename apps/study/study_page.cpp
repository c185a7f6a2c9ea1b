// SPDX-License-Identifier: Apache-2.0
//
// Writes the HTML page that shows all studies in a folder.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "study/study_files.h"

namespace halfspace {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kHead = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Halfspace: accuracy and speed</title>
<style>
:root { color-scheme: light dark; --ink: #222; --ground: #fff; --faint: #ddd; --front: #eef4e6; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e6e6; --ground: #16181c; --faint: #3a3d44; --front: #25301f; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--ground); max-width: 1060px; margin: 2em auto; padding: 0 1em; }
img { max-width: 100%; } table { border-collapse: collapse; font-size: 13px; }
th, td { padding: 2px 10px; text-align: right; border-bottom: 1px solid var(--faint); } th:first-child, td:first-child { text-align: left; white-space: nowrap; } .table { overflow-x: auto; }
tr.front { background: var(--front); } .pictures { display: flex; flex-wrap: wrap; gap: 10px; } figure { margin: 0; width: 200px; }
figcaption { font-size: 12px; } figure img { width: 200px; image-rendering: pixelated; } nav a { margin-right: 1em; }
</style></head><body>
<h1>Accuracy and speed</h1>
<p>Each point is one way to draw the same thing. The x axis shows its error compared with a reference, the y axis its time; both are
logarithmic. Error bars span the quartiles of the times. The dashed line is the Pareto front, whose rows are shaded in the tables.</p>
)html";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string text_at(const OrderedJson& json, const char* key) { return escaped(json.at(key).get<std::string>()); }
std::string number_of(const OrderedJson& json) { return fmt::format("{:.4g}", json.get<double>()); }

std::string table(const OrderedJson& study) {
  std::string html = "<div class=\"table\"><table><tr><th>variant</th>";
  const OrderedJson& rows = study.at("variants");
  for (const auto& [name, value] : rows.at(0).at("parameters").items()) html += "<th>" + escaped(name) + "</th>";
  html += "<th>error</th>";
  for (const auto& [name, value] : rows.at(0).at("measures").items()) html += "<th>" + escaped(name) + "</th>";
  html += "<th>ms</th><th>quartiles</th><th>runs</th></tr>\n";
  for (const OrderedJson& row : rows) {
    html += row.at("pareto").get<bool>() ? "<tr class=\"front\"><td>" : "<tr><td>";
    html += text_at(row, "name") + "</td>";
    for (const auto& [name, value] : row.at("parameters").items()) html += "<td>" + number_of(value) + "</td>";
    html += "<td>" + number_of(row.at("error")) + "</td>";
    for (const auto& [name, value] : row.at("measures").items()) html += "<td>" + number_of(value) + "</td>";
    const OrderedJson& ms = row.at("ms");
    html += "<td>" + number_of(ms.at("median")) + "</td><td>" + number_of(ms.at("low")) + " … " + number_of(ms.at("high")) + "</td><td>" +
            number_of(ms.at("runs")) + "</td></tr>\n";
  }
  return html + "</table></div>\n";
}

std::string figure(const OrderedJson& file, const std::string& caption) {
  if (file.is_null()) return "";
  const std::string name = escaped(file.get<std::string>());
  return "<figure><a href=\"" + name + "\"><img loading=\"lazy\" alt=\"\" src=\"" + name + "\"></a><figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string section(const OrderedJson& study, bool has_chart) {
  const std::string name = text_at(study, "study");
  std::string html = "<h2 id=\"" + name + "\">" + text_at(study, "title") + "</h2>\n";
  if (has_chart)
    html += "<picture><source media=\"(prefers-color-scheme: dark)\" srcset=\"" + name + "-dark.svg\"><img src=\"" + name +
            ".svg\" alt=\"" + text_at(study, "title") + "\"></picture>\n";
  const OrderedJson &run = study.at("run"), &truth = study.at("truth");
  html += "<p>" + text_at(study, "setting") + ". Error: " + text_at(study, "error_name") + ". Time: " + text_at(study, "time_name") +
          ". Reference: " + text_at(truth, "method") + ". Its error is " + number_of(truth.at("error")) + " (" +
          text_at(truth, "error_method") + "). <code>" + text_at(run, "command") + "</code>, " + text_at(run, "date") + ", " +
          text_at(run, "processor") + ", " + std::to_string(run.at("threads").get<int>()) + " threads, " + text_at(run, "version") +
          (run.at("quick").get<bool>() ? ", <b>quick run: the numbers are not meaningful</b>" : "") + ". Data: <a href=\"" + name +
          ".csv\">CSV</a>, <a href=\"" + name + ".json\">JSON</a>.</p>\n<details><summary>Table</summary>\n" + table(study) +
          "</details>\n";
  std::string pictures = figure(truth.at("picture"), "truth");
  for (const OrderedJson& row : study.at("variants"))
    pictures += figure(row.at("picture"), text_at(row, "name")) + figure(row.at("difference"), text_at(row, "name") + ", difference");
  if (!pictures.empty()) html += "<details><summary>Pictures</summary><div class=\"pictures\">\n" + pictures + "</div></details>\n";
  return html;
}

OrderedJson read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  OrderedJson json = OrderedJson::parse(file, nullptr, false);
  if (json.is_discarded()) throw InputError(path.string() + ": not valid JSON; expected the data of a study");
  return json;
}

}  // namespace

void write_index(const std::filesystem::path& folder) {
  std::string links = "<nav>", sections;
  for (const StudyEntry& entry : studies()) {
    const std::string name(entry.name);
    const std::filesystem::path path = folder / (name + ".json");
    if (!std::filesystem::exists(path)) continue;
    try {
      sections += section(read_json(path), std::filesystem::exists(folder / (name + ".svg")));
    } catch (const nlohmann::json::exception&) {
      throw InputError(path.string() + ": not the data of a study; expected a file written by this program");
    }
    links += "<a href=\"#" + name + "\">" + name + "</a>\n";
  }
  const std::string html = kHead + links + "</nav>\n" + sections + "</body></html>\n";
  write_file(folder / "index.html", std::as_bytes(std::span(html)));
}

}  // namespace halfspace
