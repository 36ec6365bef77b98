#include "host/cli/common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "host/cli/console.hpp"
#include "host/cli/display.hpp"
#include "host/cli/show.hpp"
#include "host/engine/session_json.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::host {
namespace {

std::size_t parse_index(std::string_view text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  throw core::DataError("", "--layers", fmt::format("\"{}\" is no range of layers", whole),
                        "write first:last counted from 0, for example 0:4");
}

namespace fs = std::filesystem;

/// Whether two names mean the same file, be it there or not. Devices take any number of outputs.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const fs::file_status status = fs::status(a, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return false;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path real_a = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path real_b = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && real_a == real_b;
}

}  // namespace

void check_outputs(std::vector<fs::path> inputs, const std::vector<fs::path>& outputs) {
  std::vector<fs::path>& taken = inputs;
  for (const fs::path& output : outputs) {
    for (const fs::path& other : taken) {
      if (!same_file(output, other)) continue;
      throw core::DataError(output.string(), "",
                            "is an output, but the same file as " + other.string() + ", which would be lost",
                            "choose another name for it");
    }
    taken.push_back(output);
  }
}

std::vector<fs::path> present(std::initializer_list<std::optional<fs::path>> paths) {
  std::vector<fs::path> given;
  for (const auto& path : paths) {
    if (path) given.push_back(*path);
  }
  return given;
}

LayerRange parse_layers(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view view = text;
  LayerRange range;
  if (colon == std::string::npos) {
    range.first = range.last = parse_index(view, text);
    return range;
  }
  range.last = static_cast<std::size_t>(-1) / 2;
  if (colon > 0) range.first = parse_index(view.substr(0, colon), text);
  if (colon + 1 < text.size()) range.last = parse_index(view.substr(colon + 1), text);
  return range;
}

PreparedJob prepare_and_warn(const JobOptions& options, const std::vector<fs::path>& more) {
  Job job = load_job(options.job, options.profile);
  job.print.look_ahead = options.look_ahead;
  job.full_quality = options.full_quality;
  PreparedJob prepared = prepare(std::move(job), options.layers);
  prepared.threads = options.threads;
  std::vector<fs::path> outputs = more;
  if (options.outputs.report) outputs.push_back(*options.outputs.report);
  check_outputs(files_of(prepared.job).all(), outputs);
  for (const std::string& warning : prepared.job.warnings) show(stderr, "note: {}\n", warning);
  for (const std::string& warning : prepared.part->warnings()) show(stderr, "note: {}\n", warning);
  return prepared;
}

void tell_about_spool(Spool& spool, const StreamResult& result) {
  if (const auto problem = spool.journal().problem()) show(stderr, "warning: {}\n", *problem);
  if (result.ending == Ending::completed || !result.begun) return;
  show(stderr, "to go on with this print: unicursal resume {}\n", spool.folder().filename().string());
}

Exit tell_ending(const StreamResult& result, const DisplayOptions& display) {
  if (display.json) {
    nlohmann::json end = {{"event", "end"}, {"ended", name(result.ending)}, {"parked", result.parked}};
    if (!result.reason.empty()) end["reason"] = result.reason;
    show(stdout, "{}\n", end.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (result.ending == Ending::stopped) {
    show(stdout, "stopped by the user; the printer is {}\n",
         result.parked ? "parked and cooling" : "cooling");
  }
  switch (result.ending) {
    case Ending::completed:
      return Exit::success;
    case Ending::stopped:
      return Exit::stopped;
    case Ending::failed:
      break;
  }
  return Exit::failed;
}

std::FILE* words_of(const DisplayOptions& display) {
  return display.json ? stderr : stdout;
}

StreamResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                  const StreamSettings& settings) {
  Display display(options.json ? DisplayForm::json : DisplayForm::words);
  const auto observer = [&](const Session& session, const SessionEvent& event) {
    display.show(session, event);
  };
  const auto console = [](Session& session, const std::string& words) {
    if (const std::string answer = obey(session, words); !answer.empty()) show(stderr, "{}\n", answer);
  };
  return stream(port, source, observer, settings, console);
}

StreamResult stream_with_progress(Print& print, const DisplayOptions& options) {
  return stream_with_progress(print.take_port(), print.source(), options, print.settings());
}

}  // namespace unicursal::host
