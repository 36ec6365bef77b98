#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/picture/png_bytes.hpp"
#include "tests/core/model/model_support.hpp"

using namespace unicursal::picture;

TEST_CASE("a picture is the same in a file and in memory, and one that cannot be written is named") {
  Image image(5, 3, {255, 255, 255});
  image.set(4, 2, {10, 20, 30});
  const std::string bytes = png_bytes(image);
  CHECK(bytes.starts_with("\x89PNG\r\n"));
  const unicursal::core::TempFolder folder;
  const std::filesystem::path file = folder.write("picture.png", "something that was there before");
  write_png(file, image);
  std::ifstream stream(file, std::ios::binary);
  CHECK(std::string(std::istreambuf_iterator<char>(stream), {}) == bytes);
  try {
    write_png(file / "below.png", image);
    FAIL("it was written");
  } catch (const std::system_error& problem) {
    CHECK(problem.code() == std::errc::not_a_directory);
    CHECK(std::string(problem.what()).find("below.png") != std::string::npos);
  }
}
