// Compares models of mixed filaments with measured prints:
//   bench_colours FILE...
//
// FILE is a list of measurements, as Prusa Research publishes them for its prusa-fdm-mixer
// (data/fitting-set.jsonl and data/holdout-set.jsonl): one JSON object in each line, with `lab` and the
// `combinations` of `hex` and `ratio`; a filament alone is a combination with itself. Prints the median, the
// mean and the 90th percentile of ΔE2000 of each model over all mixtures. The last row is this program's
// model after a fit (core/picture/fit_filaments.hpp): the mixtures of each file are foretold in ten parts,
// each after a fit to the other nine.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/fit_filaments.hpp"
#include "core/picture/hex_colour.hpp"

namespace {

using namespace unicursal;
using picture::Lab;
using picture::Light;

struct Mix {
  Lab measured;
  int file = 0;
  std::vector<std::string> names;
  std::vector<Light> lights;
  std::vector<double> shares;
};

constexpr double darkest = 0.0015;

using Model = std::function<Light(const Mix&)>;

/// The mean of `to(light)` in each channel, and back.
Model mean_of(double (*to)(double), double (*from)(double)) {
  return [=](const Mix& mix) {
    Light made{};
    for (std::size_t channel = 0; channel < made.size(); ++channel) {
      double sum = 0;
      for (std::size_t i = 0; i < mix.shares.size(); ++i) sum += mix.shares[i] * to(mix.lights[i][channel]);
      made[channel] = from(sum);
    }
    return made;
  };
}

Light own(const Mix& mix) {
  const picture::Filaments filaments{std::span<const Light>(mix.lights)};
  return mixed_light(mix.shares, filaments);
}

const std::vector<std::pair<const char*, Model>> models{
    {"mean of linear light", mean_of([](double v) { return v; }, [](double v) { return v; })},
    {"Kubelka-Munk, one constant", mean_of(
                                       [](double v) {
                                         return (1 - std::min(v, 0.9999)) * (1 - std::min(v, 0.9999)) /
                                                (2 * std::min(v, 0.9999));
                                       },
                                       [](double ks) { return 1 + ks - std::sqrt(ks * ks + 2 * ks); })},
    {"Beer-Lambert", mean_of([](double v) { return -std::log(v); }, [](double v) { return std::exp(-v); })},
    {"Yule-Nielsen, n = 3",
     mean_of([](double v) { return std::cbrt(v); }, [](double v) { return v * v * v; })},
    {"this program's", own}};

Lab lab_in(const nlohmann::json& lab) {
  return {lab.at("L"), lab.at("a"), lab.at("b")};
}

Light inside(Light light) {
  for (double& channel : light) channel = std::max(channel, darkest);
  return light;
}

/// Of the mixtures of one file. Appends how far each lies from what the others foretell.
void foretell(const std::vector<const Mix*>& mixes, std::vector<double>& far) {
  constexpr std::size_t parts = 10;
  std::map<std::string, std::size_t> places;
  std::vector<picture::Colour> pure;
  for (const Mix* mix : mixes)
    for (std::size_t i = 0; i < mix->names.size(); ++i)
      if (places.emplace(mix->names[i], pure.size()).second)
        pure.push_back(picture::colour_of(mix->lights[i]));
  std::vector<picture::MeasuredMixture> measured;
  for (const Mix* mix : mixes) {
    picture::MeasuredMixture one{std::vector<double>(pure.size()), light_of(mix->measured), 1};
    for (std::size_t i = 0; i < mix->names.size(); ++i)
      one.shares[places.at(mix->names[i])] += mix->shares[i];
    measured.push_back(std::move(one));
  }
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<picture::MeasuredMixture> others;
    for (std::size_t i = 0; i < measured.size(); ++i)
      if (i % parts != part) others.push_back(measured[i]);
    const auto fitted = picture::fit_filaments(pure, others, picture::PureColours::kept);
    if (!fitted) throw std::runtime_error("a file has too few mixtures of one of its filaments for a fit");
    const picture::Filaments filaments(std::span<const picture::Colour>(fitted->pure), fitted->mixing);
    for (std::size_t i = part; i < measured.size(); i += parts)
      far.push_back(
          difference(mixes[i]->measured, picture::lab_of(mixed_light(measured[i].shares, filaments))));
  }
}

void show_row(const char* name, std::vector<double> far) {
  std::sort(far.begin(), far.end());
  fmt::print("{:28} {:6.2f} {:6.2f} {:6.2f}\n", name, far[far.size() / 2],
             std::accumulate(far.begin(), far.end(), 0.0) / double(far.size()), far[far.size() * 9 / 10]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::map<std::string, Light> filaments;
    std::vector<std::pair<nlohmann::json, int>> lines;
    for (int i = 1; i < argc; ++i) {
      std::ifstream file(argv[i]);
      if (!file) throw std::runtime_error(std::string(argv[i]) + " cannot be read");
      for (std::string line; std::getline(file, line);) {
        if (line.find('{') == std::string::npos) continue;
        const nlohmann::json& one = lines.emplace_back(nlohmann::json::parse(line), i).first;
        if (one.at("combinations").size() == 1)
          filaments[one.at("hex")] = inside(picture::light_of(lab_in(one.at("lab"))));
      }
    }
    std::vector<Mix> mixes;
    for (const auto& [line, file] : lines) {
      if (line.at("combinations").size() < 2) continue;
      Mix mix;
      mix.measured = lab_in(line.at("lab"));
      mix.file = file;
      for (const nlohmann::json& part : line.at("combinations")) {
        const std::string hex = part.at("hex");
        const auto known = filaments.find(hex);
        mix.lights.push_back(known != filaments.end() ? known->second
                                                      : inside(light_of(picture::colour_in(hex).value())));
        mix.shares.push_back(part.at("ratio"));
        mix.names.push_back(hex);
      }
      const double sum = std::accumulate(mix.shares.begin(), mix.shares.end(), 0.0);
      for (double& share : mix.shares) share /= sum;
      mixes.push_back(std::move(mix));
    }
    if (mixes.empty()) throw std::runtime_error("usage: bench_colours FILE...; no mixture was read");
    fmt::print("{} filaments, {} mixtures; ΔE2000 median, mean, 90th percentile\n", filaments.size(),
               mixes.size());
    for (const auto& [name, model] : models) {
      std::vector<double> far;
      for (const Mix& mix : mixes) far.push_back(difference(mix.measured, picture::lab_of(model(mix))));
      show_row(name, std::move(far));
    }
    std::vector<double> far;
    for (int file = 1; file < argc; ++file) {
      std::vector<const Mix*> mixes_of;
      for (const Mix& mix : mixes)
        if (mix.file == file) mixes_of.push_back(&mix);
      if (!mixes_of.empty()) foretell(mixes_of, far);
    }
    show_row("after a fit to the others", std::move(far));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
