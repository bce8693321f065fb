// SQLite as the run store uses it: errors are StoreErrors, statements and transactions end by themselves.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace formotion {

class Database {
 public:
  enum class Mode {
    Create,      // for writing; made where there is none
    ReadWrite,   // one that exists
    Unchanging,  // for reading, where nobody can write: no locks, no log
  };
  Database(const std::string& path, Mode mode);
  void check(int status) const;  // throws StoreError for all but success
  void run(const std::string& sql);
  sqlite3* handle() const { return handle_.get(); }
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

// Parameters count from 1, columns from 0.
class Statement {
 public:
  Statement(const Database& database, const char* sql);
  Statement& bind(int at, std::int64_t value);
  Statement& bind(int at, double value);
  Statement& bind(int at, const std::string& text);
  Statement& bind(int at, const std::vector<double>& numbers);
  Statement& bind_null(int at);
  bool step();  // whether there is a row
  void execute();

  std::int64_t integer(int column) const;
  double real(int column) const;
  bool is_null(int column) const;
  std::string text(int column) const;
  std::vector<double> numbers(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement& checked(int status);
  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// Begins now, commits when told to, rolls back otherwise.
class Transaction {
 public:
  explicit Transaction(Database& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace formotion
