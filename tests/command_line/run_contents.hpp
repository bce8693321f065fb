// What a run's store holds, as text: two runs are the same when this is.
#pragma once

#include <sqlite3.h>

#include <stdexcept>
#include <string>

namespace formotion::program {

inline std::string run_contents(const std::string& folder) {
  sqlite3* database = nullptr;
  std::string text;
  const char* sql[] = {
      "SELECT number, topology, hex(\"values\"), feasible, violation, hex(objectives), hex(worst_case), bites, work, "
      "failure, failure_text, p.text FROM evaluations e JOIN provenance p ON p.id = e.provenance ORDER BY number",
      "SELECT number, kind, hex(\"values\"), valid, violation, hex(ends), length_mm, hex(demanded), tolerance_mm, "
      "pass_work, work, p.text FROM stages s JOIN provenance p ON p.id = s.provenance ORDER BY number",
      "SELECT number FROM front ORDER BY number", "SELECT * FROM findings ORDER BY id",
      "SELECT * FROM batches ORDER BY batch"};
  bool good = sqlite3_open_v2((folder + "/run.sqlite").c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK;
  const auto row = [](void* out, int columns, char** values, char**) {
    for (int i = 0; i < columns; ++i) *static_cast<std::string*>(out) += std::string(values[i] ? values[i] : "-") + "|";
    *static_cast<std::string*>(out) += "\n";
    return 0;
  };
  for (const char* query : sql) good = good && sqlite3_exec(database, query, row, &text, nullptr) == SQLITE_OK;
  sqlite3_close(database);
  if (!good) throw std::runtime_error(folder + " holds no readable run");
  return text;
}

}  // namespace formotion::program
