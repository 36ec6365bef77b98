// The camera that takes photos of simulated prints for other tests.
#include <cstdio>
// libjpeg's header needs the types of <cstdio>.
#include <jpeglib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/camera/camera.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::camera {
namespace {

constexpr Place dots[] = {{14, 13}, {85, 12}, {86, 37}, {13, 36}, {40, 24}};
constexpr double dot_radius = 1.2;  // mm

/// Discs of the first filament in the corners of a rectangle and near its middle.
PrintedLayer dotted_layer() {
  PrintedLayer layer = empty_layer({5, 5, 95, 45}, 0.1, 0.3);
  for (std::size_t row = 0; row < layer.rows; ++row) {
    for (std::size_t column = 0; column < layer.columns; ++column) {
      const double x = layer.left + layer.pixel * (static_cast<double>(column) + 0.5);
      const double y = layer.bottom + layer.pixel * (static_cast<double>(row) + 0.5);
      for (const Place& dot : dots) {
        if (std::hypot(x - dot.x, y - dot.y) < dot_radius)
          layer.fill[layer.index(column, row)] = static_cast<std::uint8_t>(PrintedLayer::full);
      }
    }
  }
  return layer;
}

Conditions plain_photo() {
  Conditions plain;
  plain.width = 640, plain.height = 480;
  plain.bed = Bed::light;
  plain.lamp = {0, std::numbers::pi / 2, 0};
  plain.sensor = {1e6, 0.0001, 0, 0};
  plain.light.exposure = 0.6;
  return plain;
}

/// The centre of what is red within some pixels of `near`.
Place red_centre(const Photo& photo, const Place& near, double reach) {
  double x_sum = 0, y_sum = 0, sum = 0;
  for (std::size_t y = 0; y < photo.height; ++y) {
    for (std::size_t x = 0; x < photo.width; ++x) {
      const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
      if (std::hypot(px - near.x, py - near.y) > reach) continue;
      const auto colour = photo.at(x, y);
      const double red = std::max(0.0, static_cast<double>(colour[0] - colour[1]) - 30);
      x_sum += red * px, y_sum += red * py, sum += red;
    }
  }
  REQUIRE(sum > 0);
  return {x_sum / sum, y_sum / sum};
}

double linear_light(double byte) {
  const double y = byte / 255;
  return y <= 0.04045 ? y / 12.92 : std::pow((y + 0.055) / 1.055, 2.4);
}

/// What libjpeg reads, and the orientation in the EXIF segment.
struct Decoded {
  Photo photo;
  int orientation = 0;
};

Decoded decoded(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), &std::fclose);
  REQUIRE(in);
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&jpeg);
  jpeg_stdio_src(&jpeg, in.get());
  jpeg_save_markers(&jpeg, JPEG_APP0 + 1, 65535);
  REQUIRE(jpeg_read_header(&jpeg, TRUE) == JPEG_HEADER_OK);
  REQUIRE(jpeg.marker_list);
  Decoded read;
  REQUIRE(jpeg.marker_list->data_length >= 26);
  read.orientation = jpeg.marker_list->data[25];
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  read.photo = {jpeg.output_width, jpeg.output_height, {}};
  read.photo.bytes.resize(3 * read.photo.width * read.photo.height);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = &read.photo.bytes[3 * read.photo.width * jpeg.output_scanline];
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  CHECK(errors.num_warnings == 0);
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  return read;
}

}  // namespace

TEST_CASE("A photo from above is a plan of the bed", "[camera]") {
  const PrintedLayer layer = dotted_layer();
  Conditions plain = plain_photo();
  plain.view.framing = 0.9;
  const Photo photo = take_photo(layer, {"red", "blue"}, plain);
  // The dots span 75.4 mm from x = 11.8 and 27.4 mm from y = 10.8, and fill 0.9 of the width.
  const double scale = 0.9 * 640 / 75.4;
  for (const Place& dot : dots) {
    const Place expected = {320 + scale * (dot.x - 49.5), 240 - scale * (dot.y - 24.5)};
    const Place seen = red_centre(photo, expected, 20);
    CAPTURE(dot.x, dot.y, expected.x, expected.y);
    CHECK(seen.x == Approx(expected.x).margin(0.4));
    CHECK(seen.y == Approx(expected.y).margin(0.4));
  }
}

TEST_CASE("A turned, slanted and distorted photo shows each place where the pinhole says", "[camera]") {
  const PrintedLayer layer = dotted_layer();
  Conditions hard = plain_photo();
  hard.view = {2.2, 0.6, 1.1, 0.8, -0.12, 0.03};
  const Photo photo = take_photo(layer, {"red", "blue"}, hard);
  const Pinhole eye = pinhole(layer, hard);
  for (const Place& dot : dots) {
    const Place expected = eye.pixel_of(dot);
    CAPTURE(dot.x, dot.y, expected.x, expected.y);
    const Place seen = red_centre(photo, expected, 12);
    CHECK(seen.x == Approx(expected.x).margin(0.5));
    CHECK(seen.y == Approx(expected.y).margin(0.5));
  }
}

TEST_CASE("In every condition the print is within the frame, and pixels lead back to their places",
          "[camera]") {
  const PrintedLayer layer = dotted_layer();
  for (const Conditions& one : conditions()) {
    CAPTURE(one.name);
    const Pinhole eye = pinhole(layer, one);
    for (const Place& dot : dots) {
      const Place pixel = eye.pixel_of(dot);
      CHECK((pixel.x > 0 && pixel.x < static_cast<double>(one.width)));
      CHECK((pixel.y > 0 && pixel.y < static_cast<double>(one.height)));
      const Place back = eye.place_of(pixel);
      CHECK(back.x == Approx(dot.x).margin(1e-6));
      CHECK(back.y == Approx(dot.y).margin(1e-6));
    }
  }
}

TEST_CASE("A stored photo is turned as its orientation says", "[camera]") {
  const std::size_t width = 3, height = 2;
  Photo upright{width, height, std::vector<std::uint8_t>(3 * width * height)};
  for (std::size_t i = 0; i < upright.bytes.size(); ++i) upright.bytes[i] = static_cast<std::uint8_t>(i);
  struct Corner {
    int orientation;
    std::size_t x, y;              // where the upper left pixel is stored
    std::size_t right_x, right_y;  // where its right neighbour is
  };
  const Corner corners[] = {{1, 0, 0, 1, 0}, {2, 2, 0, 1, 0}, {3, 2, 1, 1, 1}, {4, 0, 1, 1, 1},
                            {5, 0, 0, 0, 1}, {6, 0, 2, 0, 1}, {7, 1, 2, 1, 1}, {8, 1, 0, 1, 1}};
  for (const Corner& corner : corners) {
    CAPTURE(corner.orientation);
    const Photo turned = stored(upright, corner.orientation);
    CHECK(turned.width == (corner.orientation < 5 ? width : height));
    CHECK(turned.at(corner.x, corner.y) == upright.at(0, 0));
    CHECK(turned.at(corner.right_x, corner.right_y) == upright.at(1, 0));
  }
}

TEST_CASE("libjpeg reads what the camera writes", "[camera]") {
  const test::TempFolder folder;
  const Photo upright = take_photo(dotted_layer(), {"red", "blue"}, plain_photo());
  write_photo(folder / "photo.jpg", upright, 90, 6);
  const Decoded read = decoded(folder / "photo.jpg");
  CHECK(read.orientation == 6);
  REQUIRE(read.photo.width == 480);
  REQUIRE(read.photo.height == 640);
  const Photo turned = stored(upright, 6);
  double difference = 0;
  for (std::size_t i = 0; i < turned.bytes.size(); ++i)
    difference += std::abs(turned.bytes[i] - read.photo.bytes[i]);
  CHECK(difference / static_cast<double>(turned.bytes.size()) < 4);
}

TEST_CASE("A photo is as noisy as asked, and the same again with the same seed", "[camera]") {
  const PrintedLayer layer = dotted_layer();
  Conditions noisy = plain_photo();
  noisy.sensor = {1000, 0.004, 0, 0};
  const Photo first = take_photo(layer, {"red", "blue"}, noisy);
  CHECK(take_photo(layer, {"red", "blue"}, noisy).bytes == first.bytes);
  noisy.seed = 2;
  const Photo second = take_photo(layer, {"red", "blue"}, noisy);
  double square = 0, mean = 0, count = 0;
  for (std::size_t y = 225; y < 255; ++y) {
    for (std::size_t x = 350; x < 500; ++x) {
      const double a = linear_light(first.at(x, y)[1]), b = linear_light(second.at(x, y)[1]);
      square += (a - b) * (a - b), mean += (a + b) / 2, count += 1;
    }
  }
  mean /= count;
  const double expected = std::sqrt(mean / 1000 + 0.004 * 0.004);
  CHECK(std::sqrt(square / count / 2) == Approx(expected).epsilon(0.05));
}

TEST_CASE("Dark pigment outweighs bright, and the bed shines through a thin layer", "[camera]") {
  const Pigment yellow = pigment_named("yellow"), black = pigment_named("black"),
                white = pigment_named("white");
  const auto thick = [](const Pigment& pigment) { return recorded(reflected(pigment, 3, grey(0.5))); };
  CHECK(thick(yellow)[0] > 0.6F);
  CHECK(thick(yellow)[2] < 0.15F);
  const float half = thick(mixed(yellow, black, 0.5))[0];
  CHECK(half < 0.4F * (thick(yellow)[0] + thick(black)[0]) / 2);
  CHECK(half > thick(black)[0]);
  const auto on = [&](double thickness, double ground) {
    return recorded(reflected(white, thickness, grey(ground)))[1];
  };
  CHECK(on(0.2, 0.9) - on(0.2, 0.05) > 0.1F);
  CHECK(on(3, 0.9) - on(3, 0.05) < 0.01F);
}

}  // namespace unicursal::camera
