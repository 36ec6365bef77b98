#include "sim/bed/raster.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>

namespace unicursal::sim {

namespace {

constexpr std::uint64_t mark = 0x31726574736172'75;  // first bytes of every layer
constexpr std::uint64_t longest_side = 1 << 20;      // pixels; a longer side means a damaged stream

struct Head {
  std::uint64_t mark = 0;
  RasterFrame frame;
};

bool plausible(const Head& head) {
  const RasterFrame& f = head.frame;
  return head.mark == mark && f.columns <= longest_side && f.rows <= longest_side && f.pixel > 0 &&
         f.height > 0;
}

}  // namespace

void RasterPixel::add(double amount, std::span<const double> of) {
  const double together = fill + amount;
  for (std::size_t f = 0; f < of.size(); ++f) {
    const double mixed = (share(f) * fill + of[f] * amount) / together;
    shares[f] = static_cast<std::uint16_t>(std::lround(std::clamp(mixed, 0.0, 1.0) * whole));
  }
  fill = static_cast<float>(together);
}

RasterWriter::RasterWriter(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), file.string());
  ::signal(SIGPIPE, SIG_IGN);
}

RasterWriter::~RasterWriter() {
  if (file_ >= 0) ::close(file_);
}

void RasterWriter::layer(const LayerRaster& raster) {
  const Head head{mark, raster.frame()};
  if (!write(&head, sizeof head)) return;
  std::vector<RasterPixel> row(head.frame.columns);
  for (std::uint64_t y = 0; y < head.frame.rows; ++y) {
    raster.read_row(y, row);
    if (!write(row.data(), row.size() * sizeof(RasterPixel))) return;
  }
}

bool RasterWriter::write(const void* bytes, std::size_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (file_ >= 0 && count > 0) {
    const auto written = ::write(file_, from, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      ::close(file_);
      file_ = -1;
      break;
    }
    from += written;
    count -= static_cast<std::size_t>(written);
  }
  return file_ >= 0;
}

RasterReader::~RasterReader() {
  if (file_ >= 0) ::close(file_);
}

std::optional<RasterFrame> RasterReader::next() {
  Head head;
  const std::size_t count = read(&head, sizeof head);
  if (count == 0) return std::nullopt;
  if (count < sizeof head) throw RasterError("the simulator's rasters end in the middle of a layer");
  if (!plausible(head)) throw RasterError("the simulator's rasters have an unexpected format");
  return head.frame;
}

void RasterReader::read_row(std::span<RasterPixel> pixels) {
  if (read(pixels.data(), pixels.size_bytes()) < pixels.size_bytes())
    throw RasterError("the simulator's rasters end in the middle of a layer");
}

/// Returns the number of bytes read, which is less than `count` only at the end.
std::size_t RasterReader::read(void* bytes, std::size_t count) {
  char* to = static_cast<char*>(bytes);
  std::size_t done = 0;
  while (done < count) {
    const auto got = ::read(file_, to + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw RasterError(std::string("the simulator's rasters cannot be read: ") + std::strerror(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace unicursal::sim
