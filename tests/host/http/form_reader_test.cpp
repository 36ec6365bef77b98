// Forms as slicers send them, in pieces of any size, sound and hostile; Python's reader is the second
// opinion.
#include "host/http/form_reader.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>

#include <nlohmann/json.hpp>
#include <vector>

#include "core/numeric/random.hpp"
#include "host/http/http_message.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using host::FormPart;
using host::FormReader;
using host::HttpError;

namespace {

struct Part {
  std::string name, filename, content;
  bool operator==(const Part&) const = default;
};

class Collected final : public host::FormTaker {
 public:
  std::vector<Part> parts;
  std::size_t pieces = 0, ends = 0;

  void begin(const FormPart& part) override {
    parts.push_back({part.name, part.filename.value_or("(none)"), ""});
  }
  void take(std::string_view bytes) override {
    parts.back().content += bytes;
    ++pieces;
  }
  void end() override { ++ends; }
};

const std::string boundary = "------------------------4ebf00fbcf09";

std::vector<Part> read(const std::string& form, std::size_t piece = 1 << 20) {
  Collected collected;
  FormReader reader(boundary, collected);
  for (std::size_t at = 0; at < form.size(); at += piece)
    reader.add(std::string_view(form).substr(at, piece));
  reader.finish();
  CHECK(collected.ends == collected.parts.size());
  return collected.parts;
}

int refused(const std::string& form, std::size_t piece = 1 << 20) {
  try {
    read(form, piece);
  } catch (const HttpError& error) {
    return error.status();
  }
  return 200;
}

std::string part(const std::string& head, const std::string& content) {
  return "--" + boundary + "\r\n" + head + "\r\n\r\n" + content + "\r\n";
}

std::string field(const std::string& name, const std::string& content) {
  return part("Content-Disposition: form-data; name=\"" + name + "\"", content);
}

std::string file(const std::string& disposition, const std::string& content) {
  return part("Content-Disposition: form-data; name=\"file\"; " + disposition +
                  "\r\nContent-Type: application/octet-stream",
              content);
}

const std::string end = "--" + boundary + "--\r\n";

std::string name_of(const std::string& disposition) {
  return read(file(disposition, "x") + end).at(0).filename;
}

/// Bytes in which beginnings of the boundary are frequent.
std::string tricky(core::Random& random) {
  const std::string delimiter = "\r\n--" + boundary;
  std::string bytes;
  for (std::size_t i = random.below(40); i > 0; --i) {
    const std::size_t cut = random.below(delimiter.size());  // never the whole delimiter
    bytes += random.below(2) == 0 ? delimiter.substr(0, cut) : std::string(random.below(3), '\r');
    bytes += static_cast<char>(random.below(256));
    if (bytes.find(delimiter) != std::string::npos) bytes.clear();
  }
  return bytes;
}

std::string random_form(core::Random& random, std::vector<Part>& parts) {
  std::string form;
  for (std::size_t i = 1 + random.below(4); i > 0; --i) {
    const std::string content = tricky(random);
    const bool is_file = random.below(2) == 0;
    const std::string name = "part" + std::to_string(i);
    parts.push_back({is_file ? "file" : name, is_file ? "a b.stl" : "(none)", content});
    form += is_file ? file("filename=\"a b.stl\"", content) : field(name, content);
  }
  return form + end;
}

}  // namespace

TEST_CASE("a form of a slicer is read part by part") {
  const std::vector<Part> parts = read(field("print", "true") + field("path", "") +
                                       file("filename=\"leaf.stl\"", "solid\r\n-\r\n--") + end);
  CHECK(parts == std::vector<Part>{{"print", "(none)", "true"},
                                   {"path", "(none)", ""},
                                   {"file", "leaf.stl", "solid\r\n-\r\n--"}});
  CHECK(read(field("a", "x") + "--" + boundary + "--").size() == 1);  // the last line's end may be absent
}

TEST_CASE("a form in any pieces is the same form") {
  for (std::uint64_t round = 0; round < 300; ++round) {
    core::Random random(round);
    std::vector<Part> parts;
    const std::string form = random_form(random, parts);
    CAPTURE(round);
    for (const std::size_t piece : {std::size_t{1}, 2 + random.below(60), form.size()})
      REQUIRE(read(form, piece) == parts);
    Collected collected;
    FormReader reader(boundary, collected);
    for (std::size_t at = 0; at < form.size();) {
      const std::size_t size = 1 + random.below(200);
      reader.add(std::string_view(form).substr(at, size));
      at += size;
    }
    REQUIRE(collected.parts == parts);
    // Cut anywhere, it is refused, and wherever it is cut into pieces before that.
    const std::string cut = form.substr(0, random.below(form.size() - 3));
    REQUIRE(refused(cut) == 400);
    REQUIRE(refused(cut, 7) == 400);
  }
}

TEST_CASE("names of files come as they were sent") {
  CHECK(name_of("filename=\"a \\\"b\\\".stl\"") == "a \"b\".stl");
  CHECK(name_of("filename=\"C:\\Users\\me\\leaf.stl\"") == "C:\\Users\\me\\leaf.stl");
  CHECK(name_of("filename=\"a; name=b.stl\"") == "a; name=b.stl");
  CHECK(name_of("FileName=leaf.stl") == "leaf.stl");
  CHECK(name_of("filename=\"W\xc3\xbcrfel.stl\"") == "W\xc3\xbcrfel.stl");
  CHECK(name_of("filename=\"x.stl\"; filename*=UTF-8''W%C3%BCrfel%2fa.stl") == "W\xc3\xbcrfel/a.stl");
  CHECK(name_of("filename=\"\"").empty());
}

TEST_CASE("unusual forms are refused with a sentence") {
  const std::string sound = field("a", "x");
  CHECK(refused("") == 400);
  CHECK(refused("x" + sound + end) == 400);     // text before
  CHECK(refused(sound + end + "more") == 400);  // and behind
  CHECK(refused(sound) == 400);                 // no end
  CHECK(refused("\r\n" + sound + end) == 400);
  CHECK(refused("--" + boundary + " \r\n" + end) == 400);
  CHECK(refused("--" + boundary + "\r\n\r\nx\r\n" + end) == 400);  // no head
  CHECK(refused(part("Content-Type: text/plain", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: attachment; name=\"a\"", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"a\"; name=\"b\"", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"a", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"a\x01\"", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"a\"\nX: y", "x") + end) == 400);
  CHECK(
      refused(part("Content-Disposition: form-data; name=\"a\"\r\nContent-Disposition: form-data; name=\"b\"",
                   "x") +
              end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"a\"\r\nContent-Transfer-Encoding: base64", "x") +
                end) == 400);
  CHECK(refused(file("filename*=latin-1''x.stl", "x") + end) == 400);
  CHECK(refused(file("filename*=UTF-8''x%4", "x") + end) == 400);
  CHECK(refused(part("Content-Disposition: form-data; name=\"" + std::string(9000, 'a') + "\"", "x") + end) ==
        431);
  CHECK(refused("--" + boundary + "\r\n" + std::string(100000, 'a')) == 431);
  std::string many;
  for (std::size_t i = 0; i <= host::most_parts; ++i) many += sound;
  CHECK(refused(many + end) == 413);
}

TEST_CASE("the boundary is taken from the type of the content") {
  CHECK(host::form_boundary("multipart/form-data; boundary=abc") == "abc");
  CHECK(host::form_boundary("Multipart/Form-Data; charset=utf-8; boundary=\"a b:c\"") == "a b:c");
  const auto status = [](const std::string& type) {
    try {
      host::form_boundary(type);
    } catch (const HttpError& error) {
      return error.status();
    }
    return 200;
  };
  CHECK(status("application/json") == 415);
  CHECK(status("") == 415);
  CHECK(status("multipart/mixed; boundary=a") == 415);
  CHECK(status("multipart/form-data") == 400);
  CHECK(status("multipart/form-data; boundary=") == 400);
  CHECK(status("multipart/form-data; boundary=\"a\r\"") == 400);
  CHECK(status("multipart/form-data; boundary=" + std::string(71, 'a')) == 400);
}

TEST_CASE("what looks like a boundary all the time costs no more than other bytes") {
  // 20 MB that end each match at its last byte; a reader that looks back would need the square of that.
  const std::string almost = "\r\n--" + boundary.substr(0, boundary.size() - 1);
  std::string content;
  while (content.size() < 20'000'000) content += almost;
  const auto begun = std::chrono::steady_clock::now();
  CHECK(read(file("filename=\"a.stl\"", content) + end, 1024).at(0).content == content);
  CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20));
}

TEST_CASE("Python's reader of forms finds the same parts") {
  const test::TempFolder folder;
  folder.write("read.py", R"(import json, sys, warnings
warnings.simplefilter('ignore')
try:
    import cgi
except ImportError:
    sys.exit(77)  # Python 3.13 has no such module
form = open(sys.argv[1], 'rb')
size = len(form.read())
form.seek(0)
parts = cgi.FieldStorage(fp=form, environ={'REQUEST_METHOD': 'POST', 'CONTENT_LENGTH': str(size)}, encoding='latin-1',
    headers={'content-type': 'multipart/form-data; boundary=' + sys.argv[2], 'content-length': str(size)},
    keep_blank_values=True)
def text(value):
    return value if isinstance(value, str) else value.decode('latin-1')
print(json.dumps([[p.name, p.filename or '(none)', text(p.value).encode('latin-1').hex()] for p in parts.list]))
)");
  int compared = 0;
  for (std::uint64_t round = 1000; round < 1012; ++round) {
    core::Random random(round);
    std::vector<Part> parts;
    const std::string form = random_form(random, parts);
    folder.write("form", form);
    const std::string command = "python3 " + (folder / "read.py").string() + " " +
                                (folder / "form").string() + " " + boundary + " > " +
                                (folder / "said").string();
    const int code = std::system(command.c_str());
    if (WEXITSTATUS(code) == 77) continue;
    REQUIRE(code == 0);
    const auto said = nlohmann::json::parse(test::read_text(folder / "said"));
    const std::vector<Part> ours = read(form, 100);
    REQUIRE(said.size() == ours.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
      std::string hexadecimal;
      for (const char byte : ours[i].content)
        hexadecimal += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      CHECK(said[i][0] == ours[i].name);
      CHECK(said[i][1] == ours[i].filename);
      CHECK(said[i][2] == hexadecimal);
    }
    ++compared;
  }
  WARN(compared << " forms compared");
}
