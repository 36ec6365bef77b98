#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "core/picture/colour_names.hpp"
#include "core/picture/hex_colour.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/job/colour_mixture.hpp"
#include "host/job/profile.hpp"
#include "host/report/gamut_picture.hpp"

namespace unicursal::host {
namespace {

class Colours final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "colours", "Prepare a job", "Show the colours that a printer's filaments make.",
                    "unicursal colours diamond.toml \"#e0604a\" --picture colours.png");
    add_value(app, "PROFILE", file_, " ", "The printer profile, with its [[filament]].").required();
    app.add_option("COLOUR", wanted_,
                   "Colours to be made, such as \"#e0604a\": their shares, and how near they come.")
        ->option_text(" ");
    add_value(app, "--picture", picture_, "FILE",
              "Write a picture of all colours that the filaments make to this PNG file.");
    add_note(
        app,
        "Without COLOUR the command lists steps between every two filaments, and even mixtures of three. "
        "The colours are computed from those of the filaments, which the profile names; a print may look "
        "different, since filaments differ in how far light goes through them. A job asks for a colour "
        "by mixture.NAME = \"#e0604a\".");
    return app;
  }

  Exit run() override {
    const Profile profile = load_profile(file_);
    const std::vector<picture::Colour> wanted = colours_in(wanted_);
    const std::size_t feeders = profile.printer.feeders;
    for (std::size_t f = 0; f < feeders; ++f) {
      const Filament& filament = profile.filaments.of_feeders.at(f);
      show(stdout, "feeder {}: {} {}\n", f + 1, picture::hex_of(filament.colour), filament.name);
    }
    for (const picture::Colour colour : wanted)
      show(stdout, "{}\n", in_words(mixture_near(colour, profile), colour));
    if (wanted_.empty()) list(profile);
    if (picture_) {
      picture::write_png(*picture_, gamut_picture(profile.filaments.colours(), feeders));
      show(stdout, "picture:  {}\n", picture_->string());
    }
    return Exit::success;
  }

 private:
  static std::vector<picture::Colour> colours_in(const std::vector<std::string>& texts) {
    std::vector<picture::Colour> colours;
    for (const std::string& text : texts) {
      const auto colour = picture::colour_in(text);
      if (!colour)
        throw core::DataError("", "COLOUR", "\"" + text.substr(0, 40) + "\" is not a colour",
                              "write six hexadecimal digits, such as \"#e0604a\"");
      colours.push_back(*colour);
    }
    return colours;
  }

  static void list(const Profile& profile) {
    const std::size_t feeders = profile.printer.feeders;
    const picture::Filaments colours = profile.filaments.colours();
    const auto line = [&](const std::vector<double>& asked) {
      const gcode::Mixture mixture =
          gcode::Mixture(gcode::Shares::of(asked)).with_floor(profile.printer.floor_share);
      const picture::Light light = picture::mixed_light(mixture.shares(), colours);
      show(stdout, "{}  {}  {}\n", shares_text(mixture), picture::hex_of(picture::colour_of(light)),
           picture::name_of(picture::lab_of(light)));
    };
    for (std::size_t a = 0; a < feeders; ++a) {
      for (std::size_t b = a + 1; b < feeders; ++b) {
        for (const double part : {0.25, 0.5, 0.75}) {
          std::vector<double> shares(feeders);
          shares[a] = 1 - part;
          shares[b] = part;
          line(shares);
        }
      }
    }
    for (std::size_t a = 0; a < feeders; ++a) {
      for (std::size_t b = a + 1; b < feeders; ++b) {
        for (std::size_t c = b + 1; c < feeders; ++c) {
          std::vector<double> shares(feeders);
          shares[a] = shares[b] = shares[c] = 1;
          line(shares);
        }
      }
    }
  }

  std::filesystem::path file_;
  std::vector<std::string> wanted_;
  std::optional<std::filesystem::path> picture_;
};

}  // namespace

std::unique_ptr<Command> make_colours() {
  return std::make_unique<Colours>();
}

}  // namespace unicursal::host
