// SPDX-License-Identifier: Apache-2.0
#include "farmbench/submission/internal/submission.h"

#include <algorithm>

#include "core/contains.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/methods.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

bool is_sha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string text_in(const json& document, const char* key) {
  return document.contains(key) && document[key].is_string() ? document[key].get<std::string>()
                                                             : "";
}

void read_statement(const fs::path& file, Submission& submission, Problems& problems) {
  const std::string name = file.filename().string();
  if (!fs::is_regular_file(file)) {
    problems.add(name, "is missing; it says {\"method\": \"my-method\"}");
    return;
  }
  const json document = json::parse(read_json_text(file), nullptr, false);
  if (!document.is_object()) {
    problems.add(name, "is no JSON object; it says {\"method\": \"my-method\"}");
    return;
  }
  for (const auto& [key, value] : document.items()) {
    if (key != "method" && key != "program_sha256" && key != "comment")
      problems.add(name, "\"" + key + "\" is none of method, program_sha256, comment");
  }
  submission.method = text_in(document, "method");
  submission.program_sha256 = text_in(document, "program_sha256");
  if (!is_table_name(submission.method))
    problems.add(name, "method is no name of 1 to 40 letters, digits, '-' and '_'");
  if (contains(known_methods(), submission.method, &Method::name))
    problems.add(name,
                 "\"" + submission.method + "\" is one of Plotscan's methods; choose another");
  if (document.contains("program_sha256") && !is_sha256(submission.program_sha256))
    problems.add(name, "program_sha256 is no SHA-256: 64 digits 0 to 9, a to f");
}

void read_task(const fs::path& file, Submission& submission, Problems& problems) {
  if (!fs::exists(file)) return;
  const json document = json::parse(read_json_text(file), nullptr, false);
  const bool is_task = document.is_object() && document.contains("fields") &&
                       document["fields"].is_array() &&
                       std::ranges::all_of(document["fields"], [](const json& field) {
                         return field.is_object() && field.contains("field") &&
                                field.contains("farm_sha256") && field.contains("sha256");
                       });
  if (is_task)
    submission.task = document;
  else
    problems.add(file.filename().string(), "is not the task.json of an export");
}

}  // namespace

bool Submission::in_given_boxes() const {
  const bool were_given = task.is_object() && task.value("boxes_given", json(false)) == true;
  return were_given ||
         std::ranges::any_of(fields, [](const auto& field) { return !field.second.boxes_stated; });
}

Submission read_submission(const fs::path& folder, const std::vector<BlindField>& fields,
                           Problems& problems) {
  if (!fs::is_directory(folder)) throw InputError(folder, "is no folder of a submission");
  Submission submission;
  read_statement(folder / "submission.json", submission, problems);
  read_task(folder / "task.json", submission, problems);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = lower_extension(entry.path());
    if (extension == ".csv" || extension == ".geojson") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const std::string code = file.stem().string();
    if (!contains(fields, code, &BlindField::code)) {
      problems.add(file.filename().string(),
                   "no field is called " + code + "; of this suite with these --seeds and " +
                       "--secret-file they are called such as " + fields.front().code);
    } else if (submission.fields.contains(code)) {
      problems.add(file.filename().string(), "the field has another file as well");
    } else {
      submission.fields[code] = read_entered_plots(file, problems);
      if (fs::is_regular_file(file)) submission.file_sha256[code] = sha256_of_file(file);
    }
  }
  if (files.empty())
    problems.add("no field has a file", "files are called FIELD.csv or FIELD.geojson, such as " +
                                            fields.front().code + ".csv");
  return submission;
}

}  // namespace plotscan::farmbench
