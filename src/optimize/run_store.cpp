#include "optimize/run_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "optimize/sqlite_database.hpp"

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
  CREATE TABLE incidents(
    id INTEGER PRIMARY KEY, stage INTEGER NOT NULL, place INTEGER NOT NULL, "values" BLOB NOT NULL,
    failure INTEGER NOT NULL, text TEXT NOT NULL, times INTEGER NOT NULL, UNIQUE(stage, place, "values"));
  CREATE TABLE batches(batch INTEGER PRIMARY KEY, evaluations INTEGER NOT NULL, stages INTEGER NOT NULL);
)";

// Made when the first design is verified.
constexpr const char* kStampTable = "CREATE TABLE IF NOT EXISTS stamps(design TEXT PRIMARY KEY, text TEXT NOT NULL)";

std::string in_folder(const std::string& folder, const char* file) { return (fs::path(folder) / file).string(); }

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
  std::int64_t generation = 0;
  NamedPoint at_point;
  struct Stored {
    std::int64_t evaluations = 0, stages = 0, findings = 0, batches = 0;
  } stored;

  Impl(std::string where, std::unique_ptr<FolderLock> held, Database::Mode mode)
      : folder(std::move(where)), lock(std::move(held)), database(in_folder(folder, kStoreFile), mode) {}

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
    generation = std::stoll("0" + meta["generation"]);
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

RunStore RunStore::create(const std::string& folder, const RunIdentity& identity, bool overwrite,
                          const NamedPoint& at_point) {
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
    Database database(fresh, Database::Mode::Create);
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
                                                        {"complete", "0"},
                                                        {"generation", "0"}};
    for (const auto& [key, value] : rows) insert.bind(1, std::string(key)).bind(2, value).execute();
    reached(at_point, "new store: before its commit");
    transaction.commit();
  }
  reached(at_point, "new store: written");
  for (const char* suffix : {"-wal", "-shm", "-journal"}) fs::remove(path + suffix, error);
  reached(at_point, "new store: before its rename");
  fs::rename(fresh, path, error);
  if (error) throw StoreError(path + ": cannot be put in place: " + error.message());
  reached(at_point, "new store: in place");
  auto impl = std::make_unique<Impl>(folder, std::move(lock), Database::Mode::ReadWrite);
  impl->database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
  impl->read_meta();
  impl->at_point = at_point;
  return RunStore(std::move(impl));
}

RunStore RunStore::open_for_writing(const std::string& folder, const std::string& program_version,
                                    const NamedPoint& at_point) {
  if (!exists(folder)) throw StoreError(folder + ": holds no run (no run.sqlite)");
  refuse_network_disk(folder);
  auto impl = std::make_unique<Impl>(folder, std::make_unique<FolderLock>(folder), Database::Mode::ReadWrite);
  impl->read_meta();
  if (impl->identity.program_version != program_version) {
    throw StoreError(folder + ": was begun by version " + impl->identity.program_version + ", this is " +
                     program_version + ": the same run cannot be promised");
  }
  impl->database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
  impl->at_point = at_point;
  return RunStore(std::move(impl));
}

RunStore RunStore::open_for_reading(const std::string& folder) {
  if (!exists(folder)) throw StoreError(folder + ": holds no run (no run.sqlite)");
  // Not read-only: after a kill the first to look must be able to recover the log. Where nothing can be written and
  // there is no log, nobody else can write either, and SQLite need not look for others.
  const bool still = ::access(folder.c_str(), W_OK) != 0 && !fs::exists(in_folder(folder, kStoreFile) + "-wal");
  auto impl = std::make_unique<Impl>(folder, nullptr, still ? Database::Mode::Unchanging : Database::Mode::ReadWrite);
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
  reached(impl.at_point, "commit: before it");
  Transaction transaction(impl.database);
  reached(impl.at_point, "commit: begun");
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
  reached(impl.at_point, "commit: without the front");
  impl.database.run("DELETE FROM front");
  Statement member(impl.database, "INSERT INTO front VALUES(?)");
  for (const Archive::Member& m : state.front().members()) member.bind(1, m.number).execute();
  if (complete) impl.database.run("UPDATE meta SET value = '1' WHERE key = 'complete'");
  reached(impl.at_point, "commit: all written");
  transaction.commit();
  reached(impl.at_point, "commit: done");
  impl.stored = {static_cast<std::int64_t>(state.evaluations().size()),
                 static_cast<std::int64_t>(state.stages().size()), static_cast<std::int64_t>(state.findings().size()),
                 state.batches()};
  impl.complete = impl.complete || complete;
}

std::int64_t RunStore::generation() const { return impl_->generation; }

void RunStore::begin_generation(const Quarantine& quarantine) {
  reached(impl_->at_point, "generation: before it");
  Transaction transaction(impl_->database);
  for (const Incident& incident : quarantine.incidents()) save(incident);
  Statement next(impl_->database, "INSERT OR REPLACE INTO meta VALUES('generation', ?)");
  next.bind(1, std::to_string(impl_->generation + 1)).execute();
  reached(impl_->at_point, "generation: all written");
  transaction.commit();
  ++impl_->generation;
  reached(impl_->at_point, "generation: done");
}

Quarantine RunStore::quarantine() const {
  Quarantine quarantine;
  Statement rows(impl_->database, "SELECT stage, place, \"values\", failure, text, times FROM incidents ORDER BY id");
  while (rows.step()) {
    quarantine.restore({{rows.integer(0) != 0, static_cast<int>(rows.integer(1)), rows.numbers(2)},
                        static_cast<Failure>(rows.integer(3)),
                        rows.text(4),
                        static_cast<int>(rows.integer(5))});
  }
  return quarantine;
}

void RunStore::save(const Incident& incident) {
  Statement row(impl_->database,
                "INSERT INTO incidents(stage, place, \"values\", failure, text, times) VALUES(?, ?, ?, ?, ?, ?) "
                "ON CONFLICT DO UPDATE SET failure = excluded.failure, text = excluded.text, times = excluded.times");
  row.bind(1, std::int64_t{incident.subject.stage}).bind(2, std::int64_t{incident.subject.place});
  row.bind(3, incident.subject.values).bind(4, static_cast<std::int64_t>(incident.failure)).bind(5, incident.text);
  row.bind(6, std::int64_t{incident.times}).execute();
}

std::map<std::string, std::string> RunStore::stamps() const {
  std::map<std::string, std::string> said;
  Statement table(impl_->database, "SELECT 1 FROM sqlite_master WHERE name = 'stamps'");
  if (!table.step()) return said;
  Statement rows(impl_->database, "SELECT design, text FROM stamps");
  while (rows.step()) said[rows.text(0)] = rows.text(1);
  return said;
}

void RunStore::stamp(const std::map<std::string, std::string>& said) {
  Transaction transaction(impl_->database);
  impl_->database.run(kStampTable);
  Statement row(impl_->database, "INSERT OR REPLACE INTO stamps VALUES(?, ?)");
  for (const auto& [design, text] : said) row.bind(1, design).bind(2, text).execute();
  transaction.commit();
}

}  // namespace formotion
