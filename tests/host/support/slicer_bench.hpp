// A daemon with keys, and curl, which sends to it what slicers and other clients of OctoPrint's API send.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/mesh_files.hpp"

namespace unicursal::test {

struct CurlAnswer {
  int status = 0;
  std::string text;
  nlohmann::json body() const { return nlohmann::json::parse(text); }
};

/// A daemon with a profile, so that it prints models, and a key for a slicer.
class SlicerBench : public DaemonBench {
 public:
  explicit SlicerBench(std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--profile", path("jobs/bench.toml.profile")});
    serve(more);
    key = key_named("slicer", "queue");
    folder().write("plate 1.svg", sample_drawing);
  }

  std::string key;

  std::string key_named(const std::string& name, const std::string& right) const {
    const Outcome made = command({"keys", "--new", name, "--right", right});
    INFO(made.err);
    REQUIRE(made.code == 0);
    REQUIRE(made.out.size() == 33);  // as long as OctoPrint's: FDM Monster takes at most 43 characters
    return made.out.substr(0, 32);
  }

  /// `words`: curl's arguments before the address, as in a shell.
  CurlAnswer curl(const std::string& words, const std::string& target) const {
    const std::string command = "curl -s -o '" + path("said") + "' -w '%{http_code}' " + words + " 'http://" +
                                host() + target + "' > '" + path("code") + "'";
    CHECK(std::system(command.c_str()) >= 0);
    return {std::atoi(read_text(path("code")).c_str()), read_text(path("said"))};
  }
  CurlAnswer get(const std::string& target) const { return curl("-H 'X-Api-Key: " + key + "'", target); }
  CurlAnswer post(const std::string& target, const std::string& body, const std::string& with) const {
    return curl("-H 'X-Api-Key: " + with + "' -H 'Content-Type: application/json' -d '" + body + "'", target);
  }
  /// The form of PrusaSlicer, SuperSlicer and OrcaSlicer.
  CurlAnswer slic3r(const std::string& file, const std::string& name, const std::string& print = "true",
                    const std::string& folder = "") const {
    return curl("-A 'PrusaSlicer/2.5.0' -H 'X-Api-Key: " + key + "' -F print=" + print +
                    " -F 'path=" + folder + "' -F 'file=@\"" + file + "\";filename=\"" + name + "\"'",
                "/api/files/local");
  }
  /// A form in one piece, for what curl does not send.
  std::string form(const std::string& body, const std::string& more = {}) const {
    return "POST /api/files/local HTTP/1.1\r\nHost: " + host() + "\r\nX-Api-Key: " + key +
           "\r\nConnection: close\r\nContent-Type: multipart/form-data; boundary=b0\r\n" + more +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
  static std::string file_part(const std::string& name, const std::string& content) {
    return "--b0\r\nContent-Disposition: form-data; name=\"file\"; filename=\"" + name + "\"\r\n\r\n" +
           content + "\r\n";
  }
  /// Everything below the folder of uploads.
  std::vector<std::string> kept() const {
    std::vector<std::string> names;
    if (!std::filesystem::exists(path("state/files"))) return names;
    for (const auto& item : std::filesystem::recursive_directory_iterator(path("state/files")))
      names.push_back(item.path().lexically_relative(path("state/files")).string());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::size_t waiting() const { return ask("GET", "/api/status")["waiting"]; }
};

}  // namespace unicursal::test
