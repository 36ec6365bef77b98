#include "sim/line/wire.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {
constexpr std::size_t ftdi_packet = 62;  // bytes: a full-speed packet of 64 less two of status
constexpr double ftdi_latency = 0.016, cdc_frame = 0.001;  // s
}  // namespace

void Wire::write(double now, const std::vector<WireByte>& bytes) {
  for (const WireByte& byte : bytes) {
    down_free_ = std::max(down_free_, now) + byte_seconds();
    down_.push_back({byte, down_free_});
  }
}

std::optional<double> Wire::next_arrival() const {
  if (down_.empty()) return std::nullopt;
  for (const Travelling& next : down_) {
    if (next.byte.value == '\n' || next.byte.value == '\r') return next.at;
  }
  return down_.back().at;
}

std::vector<WireByte> Wire::arrive(double now) {
  std::vector<WireByte> bytes;
  for (; !down_.empty() && down_.front().at <= now; down_.pop_front()) bytes.push_back(down_.front().byte);
  return bytes;
}

void Wire::speak(double now, std::string_view bytes) {
  for (const char byte : bytes) {
    up_free_ = std::max(up_free_, now) + byte_seconds();
    up_.push_back({{byte, false}, up_free_});
  }
}

/// The number of waiting bytes that form the next packet.
std::size_t Wire::packet_size() const {
  if (model_.usb == Usb::ftdi) return std::min(up_.size(), ftdi_packet);
  const auto newline =
      std::find_if(up_.begin(), up_.end(), [](const Travelling& t) { return t.byte.value == '\n'; });
  return newline == up_.end() ? up_.size() : static_cast<std::size_t>(newline - up_.begin()) + 1;
}

std::optional<double> Wire::next_delivery() const {
  if (up_.empty()) return std::nullopt;
  const double whole = up_[packet_size() - 1].at;
  switch (model_.usb) {
    case Usb::none:
      return whole;
    case Usb::cdc:
      return std::max(whole, std::ceil(whole / cdc_frame) * cdc_frame);
    case Usb::ftdi:
      return up_.size() >= ftdi_packet ? std::min(whole, up_.front().at + ftdi_latency)
                                       : up_.front().at + ftdi_latency;
  }
  return whole;
}

std::string Wire::deliver(double now, std::size_t longest) {
  std::string bytes;
  for (auto due = next_delivery(); due && *due <= now && bytes.size() < longest; due = next_delivery()) {
    for (std::size_t left = packet_size(); left > 0 && up_.front().at <= now; --left) {
      bytes += up_.front().byte.value;
      up_.pop_front();
    }
  }
  return bytes;
}

void Wire::cut() {
  down_.clear();
  up_.clear();
}

}  // namespace unicursal::sim
