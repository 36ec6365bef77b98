// What firmwares say when they do not do what they were told.
#include "firmware_gcode/reply/phrases.hpp"

#include <catch2/catch.hpp>

#include "firmware_gcode/reply/reply.hpp"

using namespace unicursal::gcode;

TEST_CASE("every phrase is found in its example, with any prefix, and has a source") {
  for (const Phrase& phrase : phrases()) {
    CAPTURE(phrase.example);
    CHECK_FALSE(phrase.source.empty());
    std::string bare(phrase.example);
    for (const std::string prefix : {"Error: ", "Error:", "Warning: ", "echo:"})
      if (bare.starts_with(prefix)) bare.erase(0, prefix.size());
    for (const std::string prefix : {"", "Error:", "Error: ", "Warning: ", "echo:", "echo: "})
      CHECK(meaning_of(prefix + bare) == phrase.meaning);
  }
}

TEST_CASE("a firmware that has stopped itself is halted, whatever its prefix") {
  for (const Phrase& phrase : phrases()) {
    const Reply reply = parse_reply(phrase.example);
    const auto* error = std::get_if<reply::Error>(&reply);
    CAPTURE(phrase.example);
    CHECK((error && error->halted) == (phrase.meaning == Meaning::stopped));
  }
}

TEST_CASE("errors after which a firmware goes on, and words to people, do not mean that it has stopped") {
  for (const char* line :
       {"Error:Probing Failed", "Error:checksum mismatch, Last Line: 3", "//action:notification Home X First",
        "echo:M104 Invalid extruder 3", "echo:Home offset set", "ok", ""}) {
    CAPTURE(line);
    CHECK_FALSE(meaning_of(line));
  }
}
