#include "host/spool/record_file.hpp"

#include <catch2/catch.hpp>

#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;

namespace {

std::vector<std::string> records_in(const std::filesystem::path& file, std::uint64_t* sound = nullptr) {
  RecordReader reader(file);
  std::vector<std::string> records;
  while (auto content = reader.next()) records.push_back(*content);
  if (sound) *sound = reader.sound();
  return records;
}

const std::vector<std::string> three{"first", std::string("se\0cond", 7), std::string(300, 'x')};

std::string file_of(const std::vector<std::string>& contents) {
  std::string bytes;
  for (const std::string& content : contents) bytes += framed_record(content);
  return bytes;
}

}  // namespace

TEST_CASE("the checksum is the usual CRC-32") {
  CHECK(crc32("123456789") == 0xcbf43926U);  // the check value of the CRC catalogues
  CHECK(crc32("6789", crc32("12345")) == crc32("123456789"));
}

TEST_CASE("records are read as they were appended") {
  const test::TempFolder folder;
  {
    RecordWriter writer(folder / "r", 0);
    for (const std::string& content : three) writer.append(content);
    writer.sync();
  }
  CHECK(records_in(folder / "r") == three);
  CHECK(test::read_text(folder / "r") == file_of(three));
}

TEST_CASE("a dropped record leaves no trace") {
  const test::TempFolder folder;
  RecordWriter writer(folder / "r", 0);
  writer.append(three[0]);
  writer.append("that could not be synced");
  writer.drop_last();
  CHECK(test::read_text(folder / "r") == file_of({three[0]}));
  writer.append(three[1]);
  writer.append(three[2]);
  CHECK(test::read_text(folder / "r") == file_of(three));
}

TEST_CASE("a file torn at any byte gives the whole records before, and can be continued") {
  const test::TempFolder folder;
  const std::string whole = file_of(three);
  const std::size_t first = file_of({three[0]}).size(), second = file_of({three[0], three[1]}).size();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto file = folder.write("r", whole.substr(0, length));
    const std::size_t count = length >= second ? 2 : length >= first ? 1 : 0;
    std::uint64_t sound = 0;
    REQUIRE(records_in(file, &sound).size() == count);
    REQUIRE(sound == (count == 2 ? second : count == 1 ? first : 0));
    RecordWriter(file, sound).append("last");
    const auto records = records_in(file);
    REQUIRE(records.size() == count + 1);
    REQUIRE(records.back() == "last");
  }
}

TEST_CASE("no changed byte yields a wrong record") {
  const test::TempFolder folder;
  const std::string whole = file_of({three[0], three[1]});
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {1, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const auto records = records_in(folder.write("r", bytes));
      for (std::size_t i = 0; i < records.size(); ++i) REQUIRE(records[i] == three[i]);
      REQUIRE(records.size() < 2);
    }
  }
}

TEST_CASE("a row of zeros, which a crashed file system may leave, is not a record") {
  const test::TempFolder folder;
  CHECK(records_in(folder.write("r", framed_record("a") + std::string(4096, '\0'))).size() == 1);
}

TEST_CASE("a record that claims more than the file holds takes no memory") {
  const test::TempFolder folder;
  std::string bytes = framed_record("a");
  bytes[3] = '\x7f';  // a length of two thousand million
  CHECK(records_in(folder.write("r", bytes)).empty());
}
