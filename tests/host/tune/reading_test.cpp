#include "host/tune/reading.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

Strip sample_strip() {
  gcode::Printer printer;
  printer.nozzle = 0.6;
  printer.bead_width_range = {0.36, 1.6};
  return make_strip(printer, {});
}

StripReading answer(const std::string& text, std::string* said = nullptr) {
  std::istringstream in(text);
  std::ostringstream out;
  const StripReading reading = TerminalReader(in, out).read(sample_strip());
  if (said != nullptr) *said = out.str();
  return reading;
}

}  // namespace

TEST_CASE("Answers are ticks, with decimals, in point or comma") {
  const StripReading reading = answer("12\n 20.5 \n33,5\n");
  CHECK(reading.began == 12);
  REQUIRE(reading.half);
  CHECK(*reading.half == 20.5);
  CHECK(reading.stopped == 33.5);
  CHECK_FALSE(answer("12\n\n33\n").half);
}

TEST_CASE("A wrong answer is asked for again") {
  std::string said;
  const StripReading reading =
      answer("twelve\n-3\n1e9\nnan\n12 13\n\n12\n20\nx\n33\n", &said);  // the first must not be empty
  CHECK(reading.began == 12);
  CHECK(reading.stopped == 33);
  CHECK(said.find("from 0 to " + std::to_string(sample_strip().points.size() - 1)) != std::string::npos);
  // Out of order, and such as no nozzle does: all of it again.
  CHECK(answer("50\n\n20\n12\n20\n33\n", &said).began == 12);
  CHECK(said.find("not an order") != std::string::npos);
  CHECK(answer("12\n32\n33\n12\n20\n33\n", &said).began == 12);
  CHECK(said.find("fit no mixing nozzle") != std::string::npos);
}

TEST_CASE("q and the end of the input cancel, at every question") {
  for (const char* text : {"q\n", "12\nq\n", "12\n20\nQ\n", "", "12\n", "12\n20\n", "nonsense\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(answer(text), TuningCancelled);
  }
}

TEST_CASE("Any answer but yes counts as no") {
  const auto ask = [](const std::string& text) {
    std::istringstream in(text);
    std::ostringstream out;
    return confirmed(in, out, "Really?");
  };
  CHECK(ask("y\n"));
  CHECK(ask("yes\n"));
  for (const char* no : {"\n", "n\n", "q\n", "yellow\n"}) CHECK_FALSE(ask(no));
  CHECK_THROWS_AS(ask(""), TuningCancelled);
}

TEST_CASE("A reading is known to the next printed tick") {
  const Strip strip = sample_strip();
  const ReadVolumes read = volumes_of(strip, {20, 40, 28});
  CHECK(read.began.least == Approx(strip.at(19).passed));
  CHECK(read.began.greatest == Approx(strip.at(21).passed));
  CHECK(volumes_of(strip, {20.5, 40, {}}).began.greatest == Approx(strip.at(21.5).passed));
  // In the turn only even ticks are printed: no odd one is the nearest there.
  const auto odd = [&](double along) { return std::fmod(nearest_tick(strip, along), 2) == 1; };
  CHECK(odd(101.2));
  CHECK_FALSE(odd(171.2));
  CHECK(volumes_of(strip, {172, 280, {}}).began.least == Approx(strip.at(170).passed));
}

TEST_CASE("Readings beside the strip and out of order are refused") {
  const Strip strip = sample_strip();
  const double far = strip.length() + 1;
  for (const StripReading& wrong :
       {StripReading{-1, 30, {}}, StripReading{10, far, {}}, StripReading{30, 30, {}},
        StripReading{30, 10, {}}, StripReading{10, 30, 31}, StripReading{10, 30, 10},
        StripReading{std::nan(""), 30, {}}, StripReading{10, 30, std::nan("")}}) {
    CHECK_THROWS_AS(volumes_of(strip, wrong), core::DataError);
  }
}

}  // namespace unicursal::host
