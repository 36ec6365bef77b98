// Text that must not make its writer wait.
#include "host/loop/outlet.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <string>

using namespace unicursal::host;

namespace {

std::string gap(std::size_t count) {
  return "(" + std::to_string(count) + " lost)";
}

/// A pipe whose reader sleeps: it is full already.
class FullPipe {
 public:
  FullPipe() {
    REQUIRE(pipe2(ends_, O_CLOEXEC | O_NONBLOCK) == 0);
    const std::string page(4096, '.');
    while (::write(ends_[1], page.data(), page.size()) > 0) filled_ += page.size();
    fcntl(ends_[1], F_SETFL, 0);  // from now on a write waits
    fcntl(ends_[0], F_SETFL, 0);
  }
  ~FullPipe() {
    close(ends_[0]);
    close(ends_[1]);
  }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;

  int descriptor() const { return ends_[1]; }
  /// Reads until what came after the filling is complete, and returns that.
  std::string read_until(const std::function<bool(const std::string&)>& complete) {
    std::string text;
    char bytes[4096];
    for (std::size_t left = filled_; left > 0 || !complete(text);) {
      const ssize_t count = ::read(ends_[0], bytes, sizeof bytes);
      REQUIRE(count > 0);
      const std::size_t filling = std::min(left, static_cast<std::size_t>(count));
      left -= filling;
      text.append(bytes + filling, static_cast<std::size_t>(count) - filling);
    }
    return text;
  }
  std::string read_until(const std::string& end) {
    return read_until([&](const std::string& text) { return text.ends_with(end); });
  }

 private:
  int ends_[2] = {-1, -1};
  std::size_t filled_ = 0;
};

}  // namespace

TEST_CASE("an outlet takes text while its reader sleeps, and writes it in order later") {
  FullPipe pipe;
  Outlet outlet(pipe.descriptor(), gap);
  outlet.write("first\n");
  outlet.write("second\n");
  outlet.write("end");
  CHECK(pipe.read_until("end") == "first\nsecond\nend");
}

TEST_CASE("an outlet shows only the newest of the states that nobody has read") {
  FullPipe pipe;
  Outlet outlet(pipe.descriptor(), gap);
  outlet.write("a\n");  // the thread may be writing this one already
  outlet.write("b\n");
  outlet.refresh("1 %");
  outlet.refresh("2 %");
  outlet.write("c\n");
  outlet.refresh("3 %");
  outlet.write("end");
  CHECK(pipe.read_until("end") == "a\nb\n2 %c\n3 %end");
}

TEST_CASE("an outlet that nobody reads takes bounded memory, and reports the gap") {
  FullPipe pipe;
  constexpr std::size_t size = Outlet::most_bytes / 4;
  {
    Outlet outlet(pipe.descriptor(), gap);
    outlet.write("begin ");
    for (int i = 0; i < 10; ++i) outlet.write(std::string(size, 'x'));
    // Its destructor gives up waiting for the reader, but does not give up the text.
  }
  std::size_t kept = 0, lost = 0, looked_at = 0, letters = 0;
  const auto complete = [&](const std::string& text) {
    for (; looked_at < text.size(); ++looked_at) {
      if (text[looked_at] == 'x') ++letters;
      if (text[looked_at] == ')') lost += std::stoul(text.substr(text.rfind('(', looked_at) + 1));
    }
    kept = letters / size;
    return kept + lost >= 10;
  };
  CHECK(pipe.read_until(complete).starts_with("begin x"));
  CHECK(kept <= 5);  // four that wait, and perhaps one that is being written
  CHECK(kept + lost == 10);
}

TEST_CASE("an outlet without a reader swallows text") {
  int ends[2];
  REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
  close(ends[0]);
  {
    Outlet outlet(ends[1], gap);
    for (int i = 0; i < 100; ++i) outlet.write("nobody reads this\n");
  }
  close(ends[1]);
}
