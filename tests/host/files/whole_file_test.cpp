// Files that appear under their names only when they are complete.
#include "host/files/whole_file.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

unsigned mode(const std::filesystem::path& file) {
  struct stat found {};
  REQUIRE(lstat(file.c_str(), &found) == 0);
  return found.st_mode & 0777;
}

}  // namespace

TEST_CASE("a file is replaced when it is complete, and kept if it never is") {
  const test::TempFolder folder;
  const auto file = folder.write("out.txt", "before");
  {
    WholeFile half(file);
    half.stream() << "half";
  }
  CHECK(test::read_text(file) == "before");
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
  WholeFile whole(file);
  whole.stream() << "after";
  CHECK(test::read_text(file) == "before");
  whole.publish();
  CHECK(test::read_text(file) == "after");
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_CASE("the file behind a link is replaced, and devices are written directly") {
  const test::TempFolder folder;
  const auto file = folder.write("file", "before");
  std::filesystem::create_symlink(file, folder / "link");
  write_whole_file(folder / "link", "after");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(test::read_text(file) == "after");
  CHECK_NOTHROW(write_whole_file("/dev/null", "nothing"));
  CHECK_THROWS_AS(WholeFile(folder / "."), core::FileError);
}

TEST_CASE("a whole file has the permissions that it should have") {
  const test::TempFolder folder;
  const auto file = folder.write("file", "before");
  REQUIRE(chmod(file.c_str(), 0640) == 0);
  write_whole_file(file, "after", WholeFile::Access::as_before);
  CHECK(mode(file) == 0640);
  write_whole_file(file, "after", WholeFile::Access::owner_only);
  CHECK(mode(file) == 0600);
}

}  // namespace unicursal::host
