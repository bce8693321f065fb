// Runs that are killed, run out of disk, may not write, or meet a store that is not theirs.
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "program.hpp"
#include "run_contents.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

const std::string kEl = shipped("el_bracket.json");

std::vector<std::string> optimize(const std::string& out, const std::string& evaluations,
                                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"optimize", kEl, "--evaluations", evaluations, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool is_one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == text.size() - 1 && text.rfind("error: ", 0) == 0;
}

void change_store(const std::string& folder, const std::string& sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open((folder + "/run.sqlite").c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

// A limit on the size of files for this process and those that it starts; going over it is an error, not a signal.
struct FileLimit {
  explicit FileLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit now{bytes, before.rlim_max};
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before);
    ::signal(SIGXFSZ, SIG_DFL);
  }
  rlimit before{};
};

}  // namespace

TEST_CASE("killed a dozen times at random moments, a run ends with the same bytes, and status is sane all the while") {
  const Folder folder;
  const std::string calm = folder / "calm", out = folder / "run";
  REQUIRE(run(optimize(calm, "3000")).code == 0);

  const auto seed = static_cast<unsigned>(::getpid());
  CAPTURE(seed);
  std::mt19937 random(seed);
  int kills = 0;
  double most_ms = 150;
  std::int64_t before = 0;
  bool running_seen = false;
  for (int round = 0; kills < 12 && round < 200; ++round) {
    const bool begun = fs::exists(out + "/run.sqlite");
    Running program(begun ? std::vector<std::string>{"resume", out} : optimize(out, "3000"));
    const double until_ms = std::uniform_real_distribution<double>(0, most_ms)(random);
    ::usleep(static_cast<useconds_t>(1000 * until_ms));
    if (fs::exists(out + "/run.sqlite")) {
      const Said said = run({"status", out, "--format", "json"});
      CAPTURE(said.err);
      REQUIRE(said.code == 0);
      const Json status = Json::parse(said.out);
      const std::int64_t now = status["evaluations"];
      CHECK(now >= before);
      CHECK(now <= 3000);
      CHECK(status["budget"] == 3000);
      CHECK(status["failures"] == Json({{"error", 0}, {"crash", 0}, {"time-out", 0}}));
      if (now < 3000) CHECK(status["phase"] != "complete");
      running_seen = running_seen || status["phase"] == "running";
      // A machine that is busy needs longer to get anywhere.
      most_ms = now > before ? std::max(100.0, most_ms * 0.8) : most_ms * 1.3;
      before = now;
    } else {
      most_ms *= 1.3;
    }
    if (program.ended()) break;
    ::kill(program.pid(), SIGKILL);
    kills += program.finish().code == -SIGKILL;
  }
  REQUIRE(kills >= 5);
  CHECK(running_seen);
  REQUIRE(run({"resume", out}).code == 0);
  CHECK(read_file(out + "/pareto.json") == read_file(calm + "/pareto.json"));
  CHECK(run_contents(out) == run_contents(calm));
  CHECK_FALSE(fs::exists(out + "/quarantine"));
}

TEST_CASE("files that may not grow end a run in one line, and resume ends it with the same bytes") {
  const Folder folder;
  REQUIRE(run(optimize(folder / "calm", "3000")).code == 0);
  const std::string out = folder / "run";
  const auto whole = static_cast<rlim_t>(fs::file_size(folder / "calm/run.sqlite"));
  // Where the marks fit, the store does not; and where not even the marks do.
  for (const rlim_t bytes : {rlim_t{20000}, rlim_t{200000}, std::max<rlim_t>(1100000, whole / 2)}) {
    CAPTURE(bytes, whole);
    Said said;
    {
      const FileLimit limit(bytes);
      said = run(fs::exists(out + "/run.sqlite") ? std::vector<std::string>{"resume", out} : optimize(out, "3000"));
    }
    CAPTURE(said.err);
    if (said.code == 0) continue;  // the store was no larger
    CHECK(said.code == 2);
    CHECK(said.err.find("error: ") != std::string::npos);
    CHECK(said.err.back() == '\n');
  }
  if (fs::exists(out + "/run.sqlite")) {
    REQUIRE(run({"resume", out}).code == 0);
  } else {
    REQUIRE(run(optimize(out, "3000")).code == 0);
  }
  CHECK(read_file(out + "/pareto.json") == read_file(folder / "calm/pareto.json"));
  CHECK(run_contents(out) == run_contents(folder / "calm"));
}

TEST_CASE("a second process on the same run is refused, and the first goes on") {
  const Folder folder;
  const std::string out = folder / "run";
  Running first(optimize(out, "20000", {"--threads", "1"}));
  while (!first.ended() && !fs::exists(out + "/pareto.json") &&
         run({"status", out, "--format", "json"}).out.find("running") == std::string::npos)
    ::usleep(10000);
  REQUIRE_FALSE(first.ended());
  const Said resume = run({"resume", out}), again = run(optimize(out, "3000", {"--overwrite"}));
  for (const Said& said : {resume, again}) {
    CHECK(said.code == 2);
    CHECK(is_one_line(said.err));
    CHECK(said.err.find("another process is running this run") != std::string::npos);
  }
  CHECK_FALSE(first.ended());
  ::kill(first.pid(), SIGINT);
  CHECK(first.finish().code == 4);
}

TEST_CASE("stores of other versions and other formats are refused in one line, and not touched") {
  const Folder folder;
  const std::string out = folder / "run";
  REQUIRE(run(optimize(out, "300")).code == 0);
  change_store(out, "UPDATE meta SET value = '0.0.1' WHERE key = 'program_version'");
  const std::string before = run_contents(out);
  Said said = run({"resume", out});
  CHECK(said.code == 2);
  CHECK(is_one_line(said.err));
  CHECK(said.err.find("begun by version 0.0.1") != std::string::npos);
  CHECK(run_contents(out) == before);
  CHECK(run({"status", out}).code == 0);  // looking is allowed

  change_store(out, "PRAGMA user_version = 77");
  for (const std::string command : {"resume", "status", "report"}) {
    said = run({command, out});
    CHECK(said.code == 2);
    CHECK(is_one_line(said.err));
    CHECK(said.err.find("format is number 77") != std::string::npos);
  }
  CHECK(run_contents(out) == before);
}

// In a mount namespace of its own, so that nobody else sees what is mounted. Where the kernel does not allow that, the
// test says so and checks nothing: a folder's permissions are no substitute, root ignores them.
TEST_CASE("on a full disk and in a folder that cannot be written to a run ends in one line and loses nothing") {
  const Folder folder;
  write_file(folder / "script", R"sh(
set -eu
program=$1 problem=$2 folder=$3
mkdir "$folder/disk"
mount -t tmpfs -o size=1500k none "$folder/disk"
say() { code=0; "$program" "$@" > "$folder/out" 2> "$folder/err" || code=$?; echo "$code $(grep error "$folder/err" || true)";
}
say optimize "$problem" --evaluations 3000 --out "$folder/disk/run"
mount -o remount,size=30m "$folder/disk"
say resume "$folder/disk/run"
cp "$folder/disk/run/pareto.json" "$folder/pareto.json"
mount -o remount,ro "$folder/disk"
say status "$folder/disk/run"
say report "$folder/disk/run" --format csv
say resume "$folder/disk/run"
say optimize "$problem" --evaluations 300 --out "$folder/disk/new"
)sh");
  const std::string quiet = " > /dev/null 2>&1";
  if (std::system(("unshare -rm mount -t tmpfs none /mnt" + quiet).c_str()) != 0) {
    WARN("no mount namespaces here: full disks and read-only folders were not tried");
    return;
  }
  const std::string command = "unshare -rm sh '" + (folder / "script") + "' '" FORMOTION_PROGRAM "' '" + kEl + "' '" +
                              folder.path + "' > '" + (folder / "lines") + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  std::istringstream lines(read_file(folder / "lines"));
  std::vector<std::string> said;
  for (std::string line; std::getline(lines, line);) said.push_back(line);
  REQUIRE(said.size() == 6);
  CHECK(said[0].rfind("2 error: ", 0) == 0);
  CHECK(said[0].find("the disk is full; what was committed before is safe") != std::string::npos);
  CHECK(said[1] == "0 ");
  CHECK(said[2] == "0 ");
  CHECK(said[3] == "0 ");
  CHECK(said[4].rfind("2 error: ", 0) == 0);
  CHECK(said[4].find("Read-only file system") != std::string::npos);
  CHECK(said[5].rfind("2 error: ", 0) == 0);
  REQUIRE(run(optimize(folder / "calm", "3000")).code == 0);
  CHECK(read_file(folder / "pareto.json") == read_file(folder / "calm/pareto.json"));
}

TEST_CASE("a design that crashed twice is left out and counted, and its files repeat it") {
  const Folder folder;
  const std::string out = folder / "run";
  REQUIRE(run(optimize(out, "600")).code == 0);
  // As if the run had crashed twice at its last design, and had been killed after its first batch.
  change_store(out, R"(
    INSERT INTO incidents(stage, place, "values", failure, text, times)
      SELECT 0, topology, "values", 2, 'signal 11 ended the process that scored it', 2 FROM evaluations
      ORDER BY number DESC LIMIT 1;
    DELETE FROM front;
    DELETE FROM evaluations WHERE number > (SELECT evaluations FROM batches WHERE batch = 0);
    DELETE FROM stages WHERE number > (SELECT stages FROM batches WHERE batch = 0);
    DELETE FROM batches WHERE batch > 0;
    UPDATE meta SET value = '0' WHERE key = 'complete';
  )");
  const int code = run({"resume", out}).code;
  REQUIRE((code == 0 || code == 3));
  const Said status = run({"status", out, "--format", "json"});
  CHECK(Json::parse(status.out)["failures"] == Json({{"error", 0}, {"crash", 1}, {"time-out", 0}}));
  CHECK(run({"status", out}).out.find("failed (crash) 1, see " + out + "/quarantine") != std::string::npos);
  const Json list = Json::parse(read_file(out + "/quarantine/list.json"));
  REQUIRE(list.size() == 1);
  CHECK(list[0]["failure"] == "crash");
  CHECK(list[0]["times"] == 2);
  const std::string design = out + "/quarantine/crash-1.json";
  CHECK(list[0]["command"] == "formotion evaluate " + out + "/problem.json --design " + design);
  const Said again = run({"evaluate", out + "/problem.json", "--design", design});
  CAPTURE(again.err);
  CHECK(again.code == 0);
  // Its features are those of the design that was left out.
  CHECK(Json::parse(again.out)["features"] == Json::parse(read_file(design))["features"]);
}
