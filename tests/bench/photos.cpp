// Measures what `unicursal tune transition --photo` finds in photos of strips that nozzles with hidden
// volumes have printed: 20 nozzles, each in ten conditions; photos that
// may be refused, but must not give wrong figures; and photos that must be refused. mm³.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/host/support/photo_bench.hpp"

namespace {

using namespace unicursal;
namespace fs = std::filesystem;

constexpr unsigned usual_seed = 5;
constexpr std::size_t quick_step = 7;  // every seventh nozzle

struct Options {
  bool quick = false;
  std::optional<fs::path> keep;
  std::optional<std::string> conditions;  ///< a part of their names; of readable photos only
  std::size_t first = 0, end = 20;        ///< nozzles
  unsigned seed = usual_seed;  ///< of nozzles and noise; others also pair colours and nozzles otherwise
  std::size_t at_once = 2;
};

enum class Kind { readable, doubtful, unreadable };

/// One photo and what was found in it.
struct Shot {
  std::size_t nozzle = 0;  ///< number in the list of nozzles
  camera::FilamentPair pair;
  camera::Conditions conditions;
  Kind kind = Kind::readable;
  test::PhotoReading reading;
  double seconds = 0;  ///< of the reading
};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Right to 10 % of dead + mixing volume.
bool right(const Shot& shot, const test::HiddenNozzle& nozzle) {
  return shot.reading.dead && shot.reading.mixing && shot.reading.error(nozzle) <= 0.1;
}

bool well_done(const Shot& shot, const test::HiddenNozzle& nozzle) {
  if (shot.kind == Kind::readable) return right(shot, nozzle);
  return shot.reading.refused() || (shot.kind == Kind::doubtful && right(shot, nozzle));
}

std::string figures(const Shot& shot, const test::HiddenNozzle& nozzle) {
  const test::PhotoReading& reading = shot.reading;
  if (reading.refused())
    return fmt::format("refused, code {}: {}", reading.outcome.code, first_line(reading.outcome.err));
  if (!reading.dead || !reading.mixing) return "no figures in the output";
  const test::FoundVolume tanks = reading.tanks.value_or(test::FoundVolume{});
  return fmt::format("{:6.2f} ±{:5.2f} {:6.2f} ±{:5.2f} {:5.2f} ±{:4.2f} {:6.1f} %{}", reading.dead->value,
                     reading.dead->uncertainty, reading.mixing->value, reading.mixing->uncertainty,
                     tanks.value, tanks.uncertainty, 100 * reading.error(nozzle),
                     reading.tanks_fit(nozzle) ? "" : "  tanks wrong");
}

void print_shot(const Shot& shot, const test::HiddenNozzle& nozzle) {
  fmt::print("{:3} {:18} {:14} {:6.2f} {:6.2f} {:2} {:5.1f} s  {}\n", shot.nozzle, shot.conditions.name,
             shot.pair.from + "/" + shot.pair.to, nozzle.dead, nozzle.mixing, nozzle.tanks, shot.seconds,
             figures(shot, nozzle));
  std::fflush(stdout);
}

/// Takes the photos of one nozzle after the other, several at a time.
class Session {
 public:
  explicit Session(const Options& options) : options_(options) {
    if (options.keep) fs::create_directories(*options.keep);
    const auto pairs = camera::filament_pairs();
    const std::size_t other = options.seed - usual_seed;
    for (std::size_t n = options.first; n < nozzles_.size(); n += options.quick ? quick_step : 1) {
      for (camera::Conditions conditions : camera::conditions()) {
        if (options.conditions && conditions.name.find(*options.conditions) == std::string::npos) continue;
        conditions.seed += static_cast<std::uint32_t>(1000 * other);
        shots_.push_back({n, pairs[(n + other) % pairs.size()], conditions, Kind::readable, {}, 0});
      }
    }
    if (!options.conditions && options.seed == usual_seed) add_bad_ones(pairs[0]);
  }

  const std::vector<Shot>& operator()() {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < options_.at_once; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return shots_;
  }
  const test::HiddenNozzle& nozzle(const Shot& shot) const { return nozzles_[shot.nozzle]; }

 private:
  /// Photos that may or must be refused.
  void add_bad_ones(const camera::FilamentPair& pair) {
    const std::size_t n = std::min<std::size_t>(options_.first + 1, nozzles_.size() - 1);
    for (const camera::Conditions& conditions : camera::doubtful_conditions())
      shots_.push_back({n, pair, conditions, Kind::doubtful, {}, 0});
    for (const camera::Conditions& conditions : camera::unreadable_conditions())
      shots_.push_back({n, pair, conditions, Kind::unreadable, {}, 0});
    camera::Conditions easy = camera::conditions().front();
    easy.name = "lopsided colours";
    shots_.push_back({n, camera::lopsided_pair(), easy, Kind::doubtful, {}, 0});
    easy.name = "similar colours";
    shots_.push_back({n, camera::similar_pair(), easy, Kind::unreadable, {}, 0});
  }

  void work() {
    try {
      std::size_t printed = nozzles_.size();
      camera::PrintedLayer strip;
      for (std::size_t i = next_++; i < shots_.size(); i = next_++) {
        Shot& shot = shots_[i];
        if (shot.nozzle != printed) strip = test::printed_strip(nozzle(shot));
        printed = shot.nozzle;
        take(shot, strip);
      }
    } catch (...) {
      const std::lock_guard lock(printing_);
      failure_ = std::current_exception();
      next_ = shots_.size();
    }
  }

  void take(Shot& shot, const camera::PrintedLayer& strip) {
    const test::TempFolder folder;
    const fs::path photo = folder / "photo.jpg";
    camera::write_photo(photo, camera::take_photo(strip, shot.pair, shot.conditions), shot.conditions.quality,
                        shot.conditions.orientation);
    const auto begin = std::chrono::steady_clock::now();
    shot.reading = test::read_photo(photo);
    shot.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!well_done(shot, nozzle(shot)) && options_.keep) {
      const std::string name = fmt::format("{:02}-{}.jpg", shot.nozzle, shot.conditions.name);
      fs::copy_file(photo, *options_.keep / name, fs::copy_options::overwrite_existing);
    }
    const std::lock_guard lock(printing_);
    print_shot(shot, nozzle(shot));
  }

  const Options& options_;
  const std::vector<test::HiddenNozzle> nozzles_ = test::hidden_nozzles(options_.end, options_.seed);
  std::vector<Shot> shots_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex printing_;
  std::exception_ptr failure_;
};

struct Tally {
  std::size_t count = 0, refused = 0, within_5 = 0, within_10 = 0, tanks = 0;
  double worst = 0, seconds = 0;

  void add(const Shot& shot, const test::HiddenNozzle& nozzle) {
    ++count;
    seconds += shot.seconds;
    if (shot.reading.refused() || !shot.reading.dead || !shot.reading.mixing) {
      ++refused;
      return;
    }
    const double error = shot.reading.error(nozzle);
    worst = std::max(worst, error);
    within_5 += error <= 0.05;
    within_10 += error <= 0.1;
    tanks += shot.reading.tanks_fit(nozzle);
  }
  void print(const std::string& name) const {
    const auto share = [&](std::size_t part) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(count);
    };
    fmt::print("{:18} {:4} {:8} {:8.1f} % {:8.1f} % {:8.1f} % {:8.1f} % {:6.1f} s\n", name, count, refused,
               share(within_5), share(within_10), 100 * worst, share(tanks),
               seconds / static_cast<double>(count));
  }
};

void summarise(const Session& session, const std::vector<Shot>& shots) {
  fmt::print(
      "\nconditions         photos refused within 5 %  within 10 %     worst   tanks within   read in\n");
  Tally all;
  for (const camera::Conditions& conditions : camera::conditions()) {
    Tally tally;
    for (const Shot& shot : shots) {
      if (shot.kind != Kind::readable || shot.conditions.name != conditions.name) continue;
      tally.add(shot, session.nozzle(shot));
      all.add(shot, session.nozzle(shot));
    }
    if (tally.count > 0) tally.print(conditions.name);
  }
  for (const camera::FilamentPair& pair : camera::filament_pairs()) {
    Tally tally;
    for (const Shot& shot : shots) {
      if (shot.kind == Kind::readable && shot.pair.from == pair.from && shot.pair.to == pair.to)
        tally.add(shot, session.nozzle(shot));
    }
    if (tally.count > 0) tally.print(pair.from + "/" + pair.to);
  }
  all.print("all");
  for (const auto& [kind, name] : {std::pair{Kind::doubtful, "doubtful"}, {Kind::unreadable, "unreadable"}}) {
    std::size_t count = 0, refused = 0, wrong = 0;
    for (const Shot& shot : shots) {
      if (shot.kind != kind) continue;
      ++count;
      refused += shot.reading.refused();
      wrong += !shot.reading.refused() && !right(shot, session.nozzle(shot));
    }
    fmt::print("{} photos: {}, refused: {}, with wrong figures: {}\n", name, count, refused, wrong);
  }
}

Options options_in(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--quick") {
      options.quick = true;
    } else if (word == "--keep" && i + 1 < argc) {
      options.keep = argv[++i];
    } else if (word == "--conditions" && i + 1 < argc) {
      options.conditions = argv[++i];
    } else if (word == "--nozzles" && i + 1 < argc) {
      const std::string text = argv[++i];
      const std::size_t colon = text.find(':');
      options.first = std::stoul(text);
      options.end = colon == std::string::npos ? options.first + 1 : std::stoul(text.substr(colon + 1));
    } else if (word == "--seed" && i + 1 < argc) {
      options.seed = static_cast<unsigned>(std::stoul(argv[++i]));
    } else if (word == "--at-once" && i + 1 < argc) {
      options.at_once = std::max(1UL, std::stoul(argv[++i]));
    } else {
      throw std::runtime_error(
          "usage: bench_photos [--quick] [--keep DIR] [--conditions PART_OF_A_NAME] [--nozzles FIRST[:END]] "
          "[--seed NUMBER, 5 or more] [--at-once PHOTOS]");
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = options_in(argc, argv);
  if (options.seed < usual_seed || options.first >= options.end)
    throw std::runtime_error("nozzles are counted from 0, and seeds from 5");
  fmt::print(
      "    conditions         colours          dead mixing  k    time    dead found  mixing found  tanks "
      "found  "
      "error\n");
  Session session(options);
  summarise(session, session());
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
