#include "host/cli/qr_code.hpp"

#include <qrencode.h>

#include <memory>

namespace unicursal::host {

std::string qr_code(const std::string& text) {
  constexpr int border = 4;
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
      QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_M), &QRcode_free);
  if (!code) return {};
  const int width = code->width;
  const auto light = [&](int row, int column) {
    const bool inside = row >= 0 && row < width && column >= 0 && column < width;
    return !inside || (code->data[row * width + column] & 1) == 0;
  };
  std::string lines;
  for (int row = -border; row < width + border; row += 2) {
    for (int column = -border; column < width + border; ++column) {
      const bool above = light(row, column);
      const bool below = row + 1 < width + border && light(row + 1, column);
      lines += above && below ? "█" : above ? "▀" : below ? "▄" : " ";
    }
    lines += '\n';
  }
  return lines;
}

}  // namespace unicursal::host
