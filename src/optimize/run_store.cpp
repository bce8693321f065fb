#include "optimize/run_store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

namespace formotion {
namespace {

namespace fs = std::filesystem;

constexpr int kSchema = 2;  // user_version
constexpr const char* kStoreFile = "run.sqlite";
constexpr const char* kLockFile = "run.lock";
constexpr long kNfs = 0x6969, kSmb = 0x517b, kCifs = 0xff534d42, kSmb2 = 0xfe534d42;

constexpr const char* kTables = R"(
  CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);
  CREATE TABLE provenance(id INTEGER PRIMARY KEY, text TEXT NOT NULL UNIQUE);
  CREATE TABLE evaluations(
    number INTEGER PRIMARY KEY, topology INTEGER NOT NULL, "values" BLOB NOT NULL, feasible INTEGER NOT NULL,
    violation REAL NOT NULL, objectives BLOB NOT NULL, worst_case BLOB NOT NULL, bites TEXT, work INTEGER NOT NULL,
    failure INTEGER NOT NULL, failure_text TEXT NOT NULL, provenance INTEGER NOT NULL REFERENCES provenance(id));
  CREATE TABLE front(number INTEGER PRIMARY KEY REFERENCES evaluations(number));
  CREATE TABLE stages(
    number INTEGER PRIMARY KEY, kind INTEGER NOT NULL, "values" BLOB NOT NULL, valid INTEGER NOT NULL,
    violation REAL NOT NULL, ends BLOB NOT NULL, length_mm REAL NOT NULL, demanded BLOB NOT NULL,
    tolerance_mm REAL NOT NULL, pass_work INTEGER NOT NULL, work INTEGER NOT NULL,
    provenance INTEGER NOT NULL REFERENCES provenance(id));
  CREATE TABLE findings(id INTEGER PRIMARY KEY, topic TEXT NOT NULL, subject TEXT NOT NULL, text TEXT NOT NULL);
  CREATE TABLE batches(batch INTEGER PRIMARY KEY, evaluations INTEGER NOT NULL, stages INTEGER NOT NULL);
)";

std::string in_folder(const std::string& folder, const char* file) { return (fs::path(folder) / file).string(); }

// SQLite, with errors as StoreError.
class Database {
 public:
  Database(const std::string& path, int flags) : path_(path) {
    sqlite3* handle = nullptr;
    const int status = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
    handle_.reset(handle);
    check(status);
    sqlite3_busy_timeout(handle, 5000);
  }

  void check(int status) const {
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

  void run(const std::string& sql) { check(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr)); }
  sqlite3* handle() const { return handle_.get(); }
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

class Statement {
 public:
  Statement(const Database& database, const char* sql) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    database.check(sqlite3_prepare_v2(database.handle(), sql, -1, &statement, nullptr));
    statement_.reset(statement);
  }

  Statement& bind(int at, std::int64_t value) { return checked(sqlite3_bind_int64(statement_.get(), at, value)); }
  Statement& bind(int at, double value) { return checked(sqlite3_bind_double(statement_.get(), at, value)); }
  Statement& bind(int at, const std::string& text) {
    return checked(
        sqlite3_bind_text(statement_.get(), at, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  }
  Statement& bind(int at, const std::vector<double>& numbers) {
    static const double kNothing = 0;
    const double* data =
        numbers.empty() ? &kNothing : numbers.data();  // a null pointer would be NULL, not an empty blob
    return checked(sqlite3_bind_blob(statement_.get(), at, data, static_cast<int>(numbers.size() * sizeof(double)),
                                     SQLITE_TRANSIENT));
  }
  Statement& bind_null(int at) { return checked(sqlite3_bind_null(statement_.get(), at)); }

  bool step() {
    const int status = sqlite3_step(statement_.get());
    database_.check(status);
    return status == SQLITE_ROW;
  }
  void execute() {
    step();
    database_.check(sqlite3_reset(statement_.get()));
  }

  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
  double real(int column) const { return sqlite3_column_double(statement_.get(), column); }
  bool is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
  std::string text(int column) const {
    const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    return data ? std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)))
                : std::string();
  }
  std::vector<double> numbers(int column) const {
    const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
    std::vector<double> result(bytes / sizeof(double));
    if (bytes > 0)
      std::memcpy(result.data(), sqlite3_column_blob(statement_.get(), column), result.size() * sizeof(double));
    return result;
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Statement& checked(int status) {
    database_.check(status);
    return *this;
  }
  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// Begins now, commits when told to, rolls back otherwise.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
  ~Transaction() {
    if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  void commit() {
    database_.run("COMMIT");
    open_ = false;
  }

 private:
  Database& database_;
  bool open_ = true;
};

// The folder's lock, held until the process ends or lets go; kernel locks vanish with a killed process.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder)
      : path_(in_folder(folder, kLockFile)), file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw StoreError(path_ + ": " + std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      ::close(file_);
      throw StoreError(folder + ": another process is running this run");
    }
  }
  FolderLock(const FolderLock&) = delete;
  ~FolderLock() { ::close(file_); }

  static bool taken(const std::string& folder) {
    const int file = ::open(in_folder(folder, kLockFile).c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool free = ::flock(file, LOCK_SH | LOCK_NB) == 0;
    ::close(file);
    return !free;
  }

 private:
  std::string path_;
  int file_;
};

// The ends of a stage as numbers, three a state, and back.
std::vector<double> numbers_of(const std::vector<StageEnd>& ends) {
  std::vector<double> numbers;
  for (const StageEnd& end : ends) {
    numbers.push_back(end.to);
    numbers.push_back(end.nominal_mm);
    numbers.push_back(end.lacking_mm);
  }
  return numbers;
}
std::vector<StageEnd> ends_of(const std::vector<double>& numbers) {
  std::vector<StageEnd> ends;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    ends.push_back({static_cast<int>(numbers[i]), numbers[i + 1], numbers[i + 2]});
  return ends;
}

void refuse_network_disk(const std::string& folder) {
  struct statfs info {};
  if (::statfs(folder.c_str(), &info) != 0) return;
  const auto type = static_cast<long>(info.f_type) & 0xffffffff;
  if (type == kNfs || type == kSmb || type == kCifs || type == kSmb2) {
    throw StoreError(folder +
                     ": lies on a network disk, on which SQLite's locks cannot be trusted; run on a local disk");
  }
}

}  // namespace

struct RunStore::Impl {
  std::string folder;
  std::unique_ptr<FolderLock> lock;
  Database database;
  RunIdentity identity;
  bool complete = false;
  struct Stored {
    std::int64_t evaluations = 0, stages = 0, findings = 0, batches = 0;
  } stored;

  Impl(std::string where, std::unique_ptr<FolderLock> held, int flags)
      : folder(std::move(where)), lock(std::move(held)), database(in_folder(folder, kStoreFile), flags) {}

  void read_meta() {
    Statement version(database, "PRAGMA user_version");
    version.step();
    if (version.integer(0) != kSchema) {
      throw StoreError(database.path() + ": its format is number " + std::to_string(version.integer(0)) +
                       ", this program reads number " + std::to_string(kSchema));
    }
    std::map<std::string, std::string> meta;
    Statement rows(database, "SELECT key, value FROM meta");
    while (rows.step()) meta[rows.text(0)] = rows.text(1);
    identity = {meta["problem"], meta["problem_path"], meta["program_version"], std::stoll("0" + meta["budget"]),
                std::stoull("0" + meta["seed"])};
    complete = meta["complete"] == "1";
    Statement counts(database,
                     "SELECT (SELECT COUNT(*) FROM evaluations), (SELECT COUNT(*) FROM stages), "
                     "(SELECT COUNT(*) FROM findings), (SELECT COUNT(*) FROM batches)");
    counts.step();
    stored = {counts.integer(0), counts.integer(1), counts.integer(2), counts.integer(3)};
  }
};

RunStore::RunStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RunStore::RunStore(RunStore&&) noexcept = default;
RunStore::~RunStore() = default;

bool RunStore::exists(const std::string& folder) { return fs::exists(in_folder(folder, kStoreFile)); }

RunStore RunStore::create(const std::string& folder, const RunIdentity& identity, bool overwrite) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw StoreError(folder + ": cannot be made: " + error.message());
  refuse_network_disk(folder);
  auto lock = std::make_unique<FolderLock>(folder);
  if (exists(folder) && !overwrite)
    throw StoreError(folder + ": holds a run already; resume it, choose another --out, or give --overwrite");
  const std::string path = in_folder(folder, kStoreFile), fresh = path + ".new";
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) fs::remove(fresh + suffix, error);
  {
    Database database(fresh, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    database.run("PRAGMA synchronous = FULL");
    Transaction transaction(database);
    database.run(kTables);
    database.run("PRAGMA user_version = " + std::to_string(kSchema));
    Statement insert(database, "INSERT INTO meta VALUES(?, ?)");
    const std::pair<const char*, std::string> rows[] = {{"problem", identity.problem_text},
                                                        {"problem_path", identity.problem_path},
                                                        {"program_version", identity.program_version},
                                                        {"budget", std::to_string(identity.budget)},
                                                        {"seed", std::to_string(identity.seed)},
                                                        {"complete", "0"}};
    for (const auto& [key, value] : rows) insert.bind(1, std::string(key)).bind(2, value).execute();
    transaction.commit();
  }
  for (const char* suffix : {"-wal", "-shm", "-journal"}) fs::remove(path + suffix, error);
  fs::rename(fresh, path, error);
  if (error) throw StoreError(path + ": cannot be put in place: " + error.message());
  auto impl = std::make_unique<Impl>(folder, std::move(lock), SQLITE_OPEN_READWRITE);
  impl->database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
  impl->read_meta();
  return RunStore(std::move(impl));
}

RunStore RunStore::open_for_writing(const std::string& folder, const std::string& program_version) {
  if (!exists(folder)) throw StoreError(folder + ": holds no run (no run.sqlite)");
  refuse_network_disk(folder);
  auto impl = std::make_unique<Impl>(folder, std::make_unique<FolderLock>(folder), SQLITE_OPEN_READWRITE);
  impl->read_meta();
  if (impl->identity.program_version != program_version) {
    throw StoreError(folder + ": was begun by version " + impl->identity.program_version + ", this is " +
                     program_version + ": the same run cannot be promised");
  }
  impl->database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
  return RunStore(std::move(impl));
}

RunStore RunStore::open_for_reading(const std::string& folder) {
  if (!exists(folder)) throw StoreError(folder + ": holds no run (no run.sqlite)");
  // Not read-only: after a kill the first to look must be able to recover the log. SQLite itself falls back where the
  // folder cannot be written to.
  auto impl = std::make_unique<Impl>(folder, nullptr, SQLITE_OPEN_READWRITE);
  impl->database.run("BEGIN");  // one snapshot for all that follows, whatever a writer does
  impl->read_meta();
  return RunStore(std::move(impl));
}

const RunIdentity& RunStore::identity() const { return impl_->identity; }
bool RunStore::complete() const { return impl_->complete; }
bool RunStore::locked_by_another() const { return !impl_->lock && FolderLock::taken(impl_->folder); }

void RunStore::load(RunState& state) const {
  const Database& database = impl_->database;
  const StoreError missing(database.path() + ": evaluations are missing");
  Statement batches(database, "SELECT evaluations, stages FROM batches ORDER BY batch");
  Statement rows(database,
                 "SELECT number, topology, \"values\", feasible, violation, objectives, worst_case, bites, work, "
                 "failure, failure_text, p.text FROM evaluations e JOIN provenance p ON p.id = e.provenance "
                 "ORDER BY number");
  Statement stages(database,
                   "SELECT number, kind, \"values\", valid, violation, ends, length_mm, demanded, tolerance_mm, "
                   "pass_work, work, p.text FROM stages s JOIN provenance p ON p.id = s.provenance ORDER BY number");
  while (batches.step()) {
    while (static_cast<std::int64_t>(state.evaluations().size()) < batches.integer(0)) {
      if (!rows.step()) throw missing;
      Evaluated e;
      e.number = rows.integer(0);
      if (e.number != static_cast<std::int64_t>(state.evaluations().size()) + 1) throw missing;
      e.candidate = {static_cast<int>(rows.integer(1)), rows.numbers(2)};
      e.score = {rows.integer(3) != 0, rows.real(4), rows.numbers(5), rows.numbers(6), std::nullopt, rows.integer(8)};
      if (!rows.is_null(7)) e.score.bites = rows.text(7);
      e.score.failure = static_cast<Failure>(rows.integer(9));
      e.score.failure_text = rows.text(10);
      e.provenance = rows.text(11);
      state.restore(std::move(e));
    }
    while (static_cast<std::int64_t>(state.stages().size()) < batches.integer(1)) {
      if (!stages.step()) throw missing;
      StageRecord record;
      record.number = stages.integer(0);
      if (record.number != static_cast<std::int64_t>(state.stages().size()) + 1) throw missing;
      StageTrial& trial = record.trial;
      trial.kind = static_cast<int>(stages.integer(1));
      trial.values = stages.numbers(2);
      trial.result = {stages.integer(3) != 0, stages.real(4), ends_of(stages.numbers(5)), stages.real(6),
                      stages.integer(9)};
      for (const double demanded : stages.numbers(7)) trial.demanded.push_back(demanded != 0);
      trial.tolerance_mm = stages.real(8);
      trial.work = stages.integer(10);
      record.provenance = stages.text(11);
      state.restore(std::move(record));
    }
    state.close_batch();
  }
  Statement findings(database, "SELECT topic, subject, text FROM findings ORDER BY id");
  while (findings.step()) state.add({findings.text(0), findings.text(1), findings.text(2)});
}

void RunStore::commit(const RunState& state, bool complete) {
  Impl& impl = *impl_;
  Transaction transaction(impl.database);
  Statement remember(impl.database, "INSERT OR IGNORE INTO provenance(text) VALUES(?)");
  std::string last;
  const auto remembered = [&](const std::string& provenance) {
    if (provenance != last) remember.bind(1, provenance).execute();
    last = provenance;
  };
  Statement insert(impl.database,
                   "INSERT INTO evaluations VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                   "(SELECT id FROM provenance WHERE text = ?))");
  for (auto i = static_cast<std::size_t>(impl.stored.evaluations); i < state.evaluations().size(); ++i) {
    const Evaluated& e = state.evaluations()[i];
    remembered(e.provenance);
    insert.bind(1, e.number)
        .bind(2, std::int64_t{e.candidate.topology})
        .bind(3, e.candidate.values)
        .bind(4, std::int64_t{e.score.feasible});
    insert.bind(5, e.score.violation).bind(6, e.score.objectives).bind(7, e.score.worst_case);
    e.score.bites ? insert.bind(8, *e.score.bites) : insert.bind_null(8);
    insert.bind(9, e.score.work).bind(10, static_cast<std::int64_t>(e.score.failure)).bind(11, e.score.failure_text);
    insert.bind(12, e.provenance).execute();
  }
  Statement stage(impl.database,
                  "INSERT INTO stages VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                  "(SELECT id FROM provenance WHERE text = ?))");
  for (auto i = static_cast<std::size_t>(impl.stored.stages); i < state.stages().size(); ++i) {
    const StageRecord& record = state.stages()[i];
    const StageTrial& trial = record.trial;
    remembered(record.provenance);
    stage.bind(1, record.number).bind(2, std::int64_t{trial.kind}).bind(3, trial.values);
    stage.bind(4, std::int64_t{trial.result.valid}).bind(5, trial.result.violation);
    stage.bind(6, numbers_of(trial.result.ends)).bind(7, trial.result.length_mm);
    stage.bind(8, std::vector<double>(trial.demanded.begin(), trial.demanded.end())).bind(9, trial.tolerance_mm);
    stage.bind(10, trial.result.work).bind(11, trial.work).bind(12, record.provenance).execute();
  }
  Statement finding(impl.database, "INSERT INTO findings(topic, subject, text) VALUES(?, ?, ?)");
  for (auto i = static_cast<std::size_t>(impl.stored.findings); i < state.findings().size(); ++i) {
    const Finding& f = state.findings()[i];
    finding.bind(1, f.topic).bind(2, f.subject).bind(3, f.text).execute();
  }
  Statement batch(impl.database, "INSERT INTO batches VALUES(?, ?, ?)");
  for (std::int64_t b = impl.stored.batches; b < state.batches(); ++b) {
    const RunProgress& progress = state.history()[static_cast<std::size_t>(b)];
    batch.bind(1, b).bind(2, progress.evaluations).bind(3, progress.stages).execute();
  }
  impl.database.run("DELETE FROM front");
  Statement member(impl.database, "INSERT INTO front VALUES(?)");
  for (const Archive::Member& m : state.front().members()) member.bind(1, m.number).execute();
  if (complete) impl.database.run("UPDATE meta SET value = '1' WHERE key = 'complete'");
  transaction.commit();
  impl.stored = {static_cast<std::int64_t>(state.evaluations().size()),
                 static_cast<std::int64_t>(state.stages().size()), static_cast<std::int64_t>(state.findings().size()),
                 state.batches()};
  impl.complete = impl.complete || complete;
}

}  // namespace formotion
