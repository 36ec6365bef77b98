#include <catch2/catch.hpp>

#include <random>

#include "sim/line/words.hpp"

using namespace unicursal::sim;

TEST_CASE("a command is parsed into its words") {
  const auto command = parse_command("G1 X10 Y-2.50 E.125 F1500");
  REQUIRE(command);
  CHECK(command->is('G', 1));
  CHECK(command->value('X') == 10.0);
  CHECK(command->value('Y') == -2.5);
  CHECK(command->value('E') == 0.125);
  CHECK(command->value('F') == 1500.0);
  CHECK_FALSE(command->has('Z'));
}

TEST_CASE("words need no spaces, and E is a word, not an exponent") {
  const auto command = parse_command("G1X1E5Y+3.");
  REQUIRE(command);
  CHECK(command->value('X') == 1.0);
  CHECK(command->value('E') == 5.0);
  CHECK(command->value('Y') == 3.0);
}

TEST_CASE("a word without a number is present, but has no value") {
  const auto command = parse_command("G28 X Z");
  REQUIRE(command);
  CHECK(command->has('X'));
  CHECK(command->has('Z'));
  CHECK_FALSE(command->has('Y'));
  CHECK_FALSE(command->value('X'));
  CHECK(command->value_or('X', 7) == 7.0);
}

TEST_CASE("a command is G, M or T with a number") {
  for (const char* text : {"", " ", "g1 X1", "X10", "G", "GX1", "M", "hello", "*12", "N5"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_command(text));
  }
}

TEST_CASE("numbers are clamped, so that the arithmetic of steps cannot overflow") {
  const auto command = parse_command("G1 X" + std::string(60, '9') + " Y-" + std::string(60, '9'));
  CHECK(command->value('X') == largest_number);
  CHECK(command->value('Y') == -largest_number);
  CHECK(parse_command("G1 X0." + std::string(400, '3'))->value('X').value() == Approx(1.0 / 3));
}

TEST_CASE("any bytes at all can be parsed") {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255), length(0, 95);
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 == 0 ? "G1 " : "";
    for (int n = length(random); n > 0; --n) text += static_cast<char>(byte(random));
    const auto command = parse_command(text);
    if (!command) continue;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      CHECK(std::abs(command->value_or(letter, 0)) <= largest_number);
    }
  }
}
