#include "tests/camera/camera.hpp"

#include <algorithm>
#include <cmath>

#include "tests/camera/chance.hpp"

namespace unicursal::camera {
namespace {

constexpr std::size_t block = 16;  ///< pixels between places that are computed exactly
constexpr double lamp_part = 0.8;  ///< of the spot in uneven light, against the slope
constexpr double slope_part = 0.5;
constexpr double vignetting = 0.25;  ///< loss of light in the corners of the photo
constexpr std::size_t tones = 65536;

/// What depends smoothly on the place in the photo.
struct Ray {
  double x = 0, y = 0;  ///< of the bed, mm
  Rgb light{};          ///< factors
  float glare = 0;      ///< added
};

Ray between(const Ray& a, const Ray& b, double t) {
  const auto f = static_cast<float>(t);
  Ray ray{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), {}, a.glare + f * (b.glare - a.glare)};
  for (std::size_t i = 0; i < 3; ++i) ray.light[i] = a.light[i] + f * (b.light[i] - a.light[i]);
  return ray;
}

/// The light on the bed.
class Illumination {
 public:
  Illumination(const Light& light, const Rectangle& subject) : light_(light), subject_(subject) {
    least_ = HUGE_VAL, most_ = -HUGE_VAL;
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; j <= 20; ++j) {
        const double raw =
            uneven(subject.left + subject.width() * i / 20, subject.bottom + subject.height() * j / 20);
        least_ = std::min(least_, raw), most_ = std::max(most_, raw);
      }
    }
  }

  void shine(Ray& ray) const {
    const double part = (uneven(ray.x, ray.y) - least_) / (most_ - least_);
    const double level = std::max(0.15, light_.falloff + (1 - light_.falloff) * std::min(part, 1.1));
    const auto spot = static_cast<float>(spot_at(ray.x, ray.y));
    for (std::size_t i = 0; i < 3; ++i)
      ray.light[i] = static_cast<float>(level) * (1 + spot * (light_.spot_tint[i] - 1));
    double glare = 0;
    for (const Glare& one : light_.glares) {
      const double away = std::hypot(ray.x - subject_.left - one.x * subject_.width(),
                                     ray.y - subject_.bottom - one.y * subject_.height()) /
                          one.radius;
      glare += one.light * std::exp(-away * away * away);
    }
    ray.glare = static_cast<float>(glare);
  }

 private:
  double spot_at(double x, double y) const {
    const double away = std::hypot(x - subject_.left - light_.spot.x * subject_.width(),
                                   y - subject_.bottom - light_.spot.y * subject_.height()) /
                        light_.spot_radius;
    return std::exp(-away * away / 2);
  }
  double uneven(double x, double y) const {
    const double u = (x - subject_.left) / subject_.width() - 0.5,
                 v = (y - subject_.bottom) / subject_.height() - 0.5;
    const double slope = u * std::cos(light_.slope_towards) + v * std::sin(light_.slope_towards);
    return slope_part * slope + lamp_part * spot_at(x, y);
  }

  const Light& light_;
  Rectangle subject_;
  double least_ = 0, most_ = 1;
};

/// The linear light of a photo before the sensor, interleaved.
struct Exposure {
  std::size_t width, height;
  std::vector<float> light;
};

class Shutter {
 public:
  Shutter(const LitBed& bed, const Pinhole& pinhole, const Illumination& illumination,
          const Conditions& conditions)
      : bed_(bed), pinhole_(pinhole), illumination_(illumination), conditions_(conditions) {
    // Four samples in a turned square, spread along the motion of the camera.
    constexpr double corners[4][2] = {{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
    const Blur& blur = conditions.blur;
    for (std::size_t i = 0; i < 4; ++i) {
      const double moved = blur.motion * (static_cast<double>(i) / 3 - 0.5);
      samples_[i] = {corners[i][0] + moved * std::cos(blur.motion_towards),
                     corners[i][1] + moved * std::sin(blur.motion_towards)};
    }
  }

  Exposure operator()() const {
    Exposure seen{conditions_.width, conditions_.height, {}};
    seen.light.resize(3 * seen.width * seen.height);
    for (std::size_t row = 0; row < seen.height; row += block) {
      for (std::size_t column = 0; column < seen.width; column += block) expose(seen, column, row);
    }
    return seen;
  }

 private:
  Ray ray(std::size_t column, std::size_t row) const {
    const double px = static_cast<double>(column), py = static_cast<double>(row);
    const Place place = pinhole_.place_of({px, py});
    Ray made{place.x, place.y, {}, 0};
    illumination_.shine(made);
    const double u = 2 * px / static_cast<double>(conditions_.width) - 1;
    const double v = 2 * py / static_cast<double>(conditions_.height) - 1;
    const auto dim = static_cast<float>(1 - vignetting * (u * u + v * v) / 2);
    for (float& channel : made.light) channel *= dim;
    return made;
  }

  void expose(Exposure& seen, std::size_t column, std::size_t row) const {
    const Ray corners[4] = {ray(column, row), ray(column + block, row), ray(column, row + block),
                            ray(column + block, row + block)};
    const double across = std::hypot(corners[1].x - corners[0].x, corners[1].y - corners[0].y);
    const double down = std::hypot(corners[2].x - corners[0].x, corners[2].y - corners[0].y);
    const double size = std::max(across, down) / (2 * block);
    for (std::size_t y = row; y < std::min(row + block, seen.height); ++y) {
      const double v = (static_cast<double>(y - row) + 0.5) / block;
      const Ray first = between(corners[0], corners[2], v), last = between(corners[1], corners[3], v);
      const Place lower = {(corners[2].x - corners[0].x) / block, (corners[2].y - corners[0].y) / block};
      for (std::size_t x = column; x < std::min(column + block, seen.width); ++x) {
        const Ray here = between(first, last, (static_cast<double>(x - column) + 0.5) / block);
        const Place right = {(last.x - first.x) / block, (last.y - first.y) / block};
        Rgb sum{};
        for (const Place& sample : samples_) {
          const Rgb one = bed_.at(here.x + sample.x * right.x + sample.y * lower.x,
                                  here.y + sample.x * right.y + sample.y * lower.y, size);
          for (std::size_t i = 0; i < 3; ++i) sum[i] += one[i];
        }
        float* out = &seen.light[3 * (y * seen.width + x)];
        for (std::size_t i = 0; i < 3; ++i) out[i] = 0.25F * sum[i] * here.light[i] + here.glare;
      }
    }
  }

  const LitBed& bed_;
  const Pinhole& pinhole_;
  const Illumination& illumination_;
  const Conditions& conditions_;
  std::array<Place, 4> samples_{};
};

std::vector<float> bell(double deviation) {
  const int reach = static_cast<int>(std::ceil(2.6 * deviation));
  std::vector<float> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::exp(-i * i / (2 * deviation * deviation))));
    sum += weights.back();
  }
  for (float& weight : weights) weight /= static_cast<float>(sum);
  return weights;
}

/// Adds to each of `count` values `from` times a weight.
void add_weighted(float* to, const float* from, std::size_t count, float weight) {
  for (std::size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

/// Rows one after the other: the rows above and below that a row needs are kept before they are overwritten.
void defocus(Exposure& seen, double deviation) {
  if (deviation < 0.05) return;
  const std::vector<float> weights = bell(deviation);
  const auto reach = static_cast<std::ptrdiff_t>(weights.size() / 2);
  const std::size_t length = 3 * seen.width;
  const auto height = static_cast<std::ptrdiff_t>(seen.height);
  std::vector<std::vector<float>> rows(weights.size(), std::vector<float>(length));
  std::vector<float> padded(length + 6 * static_cast<std::size_t>(reach));
  const auto across = [&](std::ptrdiff_t row) {
    const float* from = &seen.light[static_cast<std::size_t>(row) * length];
    for (std::size_t i = 0; i < padded.size(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i) - 3 * reach;
      const auto last = static_cast<std::ptrdiff_t>(length) - 3;
      padded[i] = from[at < 0 ? (at + 3 * reach) % 3 : at >= last ? last + at % 3 : at];
    }
    std::vector<float>& to = rows[static_cast<std::size_t>(row) % rows.size()];
    std::fill(to.begin(), to.end(), 0.0F);
    for (std::size_t k = 0; k < weights.size(); ++k)
      add_weighted(to.data(), &padded[3 * k], length, weights[k]);
  };
  for (std::ptrdiff_t row = 0; row < std::min(reach, height); ++row) across(row);
  for (std::ptrdiff_t row = 0; row < height; ++row) {
    if (row + reach < height) across(row + reach);
    float* to = &seen.light[static_cast<std::size_t>(row) * length];
    std::fill(to, to + length, 0.0F);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto from =
          std::clamp(row + static_cast<std::ptrdiff_t>(k) - reach, std::ptrdiff_t{0}, height - 1);
      add_weighted(to, rows[static_cast<std::size_t>(from) % rows.size()].data(), length, weights[k]);
    }
  }
}

/// From linear light, as parts of `tones`, to bytes.
std::vector<std::uint8_t> tone_curve(double contrast) {
  std::vector<std::uint8_t> curve(tones);
  for (std::size_t i = 0; i < tones; ++i) {
    const double x = static_cast<double>(i) / (tones - 1);
    const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    const double bent = y + contrast * y * (1 - y) * (2 * y - 1);
    curve[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(bent, 0.0, 1.0)));
  }
  return curve;
}

/// Exaggerates the difference from the pixels two further on, as phones do: edges get halos.
float sharpened(const Exposure& seen, std::size_t i, float strength) {
  constexpr std::size_t reach = 2;
  const std::size_t aside = 3 * reach, beyond = 3 * reach * seen.width;
  if (strength <= 0 || i < beyond || i + beyond >= seen.light.size()) return seen.light[i];
  const float mean =
      (seen.light[i - aside] + seen.light[i + aside] + seen.light[i - beyond] + seen.light[i + beyond]) / 4;
  return seen.light[i] + strength * (seen.light[i] - mean);
}

Photo developed(const Exposure& seen, const Conditions& conditions) {
  Photo photo{seen.width, seen.height, std::vector<std::uint8_t>(seen.light.size())};
  const std::vector<std::uint8_t> curve = tone_curve(conditions.sensor.contrast);
  NormalChance chance(conditions.seed);
  const auto exposure = static_cast<float>(conditions.light.exposure);
  const auto sharpening = static_cast<float>(conditions.sensor.sharpening);
  const auto shot = static_cast<float>(1 / conditions.sensor.electrons);
  const auto read = static_cast<float>(conditions.sensor.read_noise * conditions.sensor.read_noise);
  for (std::size_t i = 0; i < seen.light.size(); ++i) {
    const float light = std::max(0.0F, sharpened(seen, i, sharpening)) * exposure;
    const float noisy = light + chance() * std::sqrt(light * shot + read);
    const float balanced = std::clamp(noisy * conditions.light.gains[i % 3], 0.0F, 1.0F);
    photo.bytes[i] = curve[static_cast<std::size_t>(balanced * static_cast<float>(tones - 1) + 0.5F)];
  }
  return photo;
}

PrintedLayer without_plastic(PrintedLayer layer) {
  std::fill(layer.fill.begin(), layer.fill.end(), std::uint8_t{0});
  return layer;
}

}  // namespace

Pinhole pinhole(const PrintedLayer& layer, const Conditions& conditions) {
  return Pinhole(conditions.view, conditions.width, conditions.height, layer.printed());
}

Photo take_photo(const PrintedLayer& layer, const FilamentPair& pair, const Conditions& conditions) {
  const Pinhole eye = pinhole(layer, conditions);
  const Illumination illumination(conditions.light, layer.printed());
  const Bed under = contrasting_bed(layer, pair, conditions.bed);
  const LitBed bed(conditions.bare ? without_plastic(layer) : layer, pair, under, conditions.lamp,
                   eye.towards_camera(), eye.visible());
  Exposure seen = Shutter(bed, eye, illumination, conditions)();
  defocus(seen, conditions.blur.defocus);
  return developed(seen, conditions);
}

Bed contrasting_bed(const PrintedLayer& layer, const FilamentPair& pair, Bed wanted) {
  constexpr double clear = 0.18;  // of light to the power of 1/3; from black to white it is 1
  const Pigment plastic = pigment_named(pair.from);
  Bed best = wanted;
  double most = 0;
  for (const Bed bed : {wanted, Bed::light, Bed::dark, Bed::gold}) {
    const Spectrum ground = colours_of(bed).first;
    const Rgb print = recorded(reflected(plastic, layer.height, ground)), bare = recorded(ground);
    double difference = 0;
    for (std::size_t i = 0; i < 3; ++i)
      difference = std::max(difference, std::abs(std::cbrt(static_cast<double>(print[i])) -
                                                 std::cbrt(static_cast<double>(bare[i]))));
    if (difference >= clear) return bed;
    if (difference > most) most = difference, best = bed;
  }
  return best;
}

}  // namespace unicursal::camera
