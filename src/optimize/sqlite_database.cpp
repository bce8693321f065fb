#include "optimize/sqlite_database.hpp"

#include <sqlite3.h>

#include <cstring>
#include <filesystem>

#include "optimize/run_store.hpp"

namespace formotion {
namespace {

constexpr int kPatience_ms = 5000;  // with other processes' locks

// A file that nobody changes, as a URI.
std::string unchanging(const std::string& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

int flags(Database::Mode mode) {
  switch (mode) {
    case Database::Mode::Create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case Database::Mode::ReadWrite:
      return SQLITE_OPEN_READWRITE;
    case Database::Mode::Unchanging:
      return SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
  }
  return SQLITE_OPEN_READONLY;
}

}  // namespace

Database::Database(const std::string& path, Mode mode) : path_(path) {
  sqlite3* handle = nullptr;
  const std::string name = mode == Mode::Unchanging ? unchanging(path) : path;
  const int status = sqlite3_open_v2(name.c_str(), &handle, flags(mode), nullptr);
  handle_.reset(handle);
  check(status);
  sqlite3_busy_timeout(handle, kPatience_ms);
}

void Database::check(int status) const {
  if (status == SQLITE_OK || status == SQLITE_ROW || status == SQLITE_DONE) return;
  std::string why = handle_ ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(status);
  switch (status & 0xff) {
    case SQLITE_FULL:
      why = "the disk is full; what was committed before is safe, and resume goes on from there";
      break;
    case SQLITE_READONLY:
      why = "it cannot be written to";
      break;
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      why = "it is damaged or no run's store (" + why + ")";
      break;
    default:
      break;
  }
  throw StoreError(path_ + ": " + why);
}

void Database::run(const std::string& sql) {
  check(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr));
}

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }

Statement::Statement(const Database& database, const char* sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  database.check(sqlite3_prepare_v2(database.handle(), sql, -1, &statement, nullptr));
  statement_.reset(statement);
}

Statement& Statement::bind(int at, std::int64_t value) {
  return checked(sqlite3_bind_int64(statement_.get(), at, value));
}
Statement& Statement::bind(int at, double value) { return checked(sqlite3_bind_double(statement_.get(), at, value)); }
Statement& Statement::bind(int at, const std::string& text) {
  return checked(sqlite3_bind_text(statement_.get(), at, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
}
Statement& Statement::bind(int at, const std::vector<double>& numbers) {
  static const double kNothing = 0;
  const double* data = numbers.empty() ? &kNothing : numbers.data();  // a null pointer would be NULL, not an empty blob
  return checked(sqlite3_bind_blob(statement_.get(), at, data, static_cast<int>(numbers.size() * sizeof(double)),
                                   SQLITE_TRANSIENT));
}
Statement& Statement::bind_null(int at) { return checked(sqlite3_bind_null(statement_.get(), at)); }

bool Statement::step() {
  const int status = sqlite3_step(statement_.get());
  database_.check(status);
  return status == SQLITE_ROW;
}
void Statement::execute() {
  step();
  database_.check(sqlite3_reset(statement_.get()));
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }
bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
std::string Statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return data ? std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)))
              : std::string();
}
std::vector<double> Statement::numbers(int column) const {
  const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  std::vector<double> result(bytes / sizeof(double));
  if (bytes > 0)
    std::memcpy(result.data(), sqlite3_column_blob(statement_.get(), column), result.size() * sizeof(double));
  return result;
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement& Statement::checked(int status) {
  database_.check(status);
  return *this;
}

Transaction::Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}
void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace formotion
