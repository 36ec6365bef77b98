// The version names the commit, wherever the sources came from: a clone, an archive of git, or a packager.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>

#include "tests/host/support/child_process.hpp"

using namespace unicursal;

namespace {

const std::string sources = test::source_folder().string();

/// Some folders in `root` that hold what the commit is found by: a clone of git's, an archive of that, a
/// folder within the clone that is not a part of it, and one without git.
constexpr auto make_folders = R"(
  make() { mkdir -p "$1/host/packaging"; cp "$sources/host/packaging/commit" "$1/host/packaging"; }
  make clone; cp "$sources/.gitattributes" clone
  git init -q clone
  git -C clone add .
  GIT_COMMITTER_DATE='2026-11-30T01:30:00 +0300' \
    git -C clone -c user.name=a -c user.email=a@example.org commit -q -m first
  git -C clone log -1 --format=%H > hash
  mkdir archive
  git -C clone archive HEAD | tar -x -C archive
  make clone/inside
  make loose)";

void shell(const std::string& root, const std::string& script) {
  REQUIRE(std::system(("set -e; export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1; sources='" +
                       sources + "'; cd '" + root + "'; " + script)
                          .c_str()) == 0);
}

}  // namespace

TEST_CASE("the version names this commit and its day") {
  const test::Outcome outcome = test::run({"--version"});
  CHECK(outcome.code == 0);
  std::smatch found;
  const std::regex form(
      R"(unicursal [0-9]+\.[0-9]+\.[0-9]+( \(commit ([0-9a-f]{10}), 20[0-9]{2}-[0-9]{2}-[0-9]{2}\))?\n)");
  REQUIRE(std::regex_match(outcome.out, found, form));
  if (std::filesystem::exists(sources + "/.git"))
    shell("/", "git -C \"$sources\" merge-base --is-ancestor " + found[2].str() + " HEAD");
}

TEST_CASE("clones and archives of git know their commit and other folders claim none") {
  const test::TempFolder folder;
  const std::string root = folder.path().string();
  shell(root, make_folders);
  folder.write("template", "v@UNICURSAL_ORIGIN@\n");
  const auto origin = [&](const std::string& name, const std::string& options = {}) {
    shell(root, "cmake " + options + " -D \"SOURCES=$PWD/" + name +
                    "\" -D TEMPLATE=template -D OUTPUT=out -P \"$sources/host/packaging/commit.cmake\"");
    return test::read_text(folder / "out");
  };
  const std::string hash = test::read_text(folder / "hash").substr(0, 10);
  const std::string expected = "v (commit " + hash + ", 2026-11-29)\n";  // in UTC
  CHECK(origin("clone") == expected);
  CHECK(origin("archive") == expected);
  CHECK(origin("clone/inside") == "v\n");
  CHECK(origin("loose") == "v\n");
  CHECK(origin("loose", "-D 'UNICURSAL_COMMIT=0123456789abcdef 86400'") ==
        "v (commit 0123456789, 1970-01-02)\n");
}
