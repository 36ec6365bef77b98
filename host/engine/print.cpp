#include "host/engine/print.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "host/engine/produce.hpp"
#include "host/engine/restart.hpp"
#include "host/files/descriptor.hpp"
#include "host/link/find_port.hpp"
#include "host/link/link.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

PrintOrder order_of(const Production& production, const std::string& port, const std::string& device) {
  PrintOrder order;
  order.job_name = production.job().file.stem().string();
  order.port = port;
  order.device = device;
  order.layer_count = production.layers();
  if (const auto layers = production.range()) order.layers = std::pair(layers->first, layers->last);
  return order;
}

SpoolError cannot_go_on(const Spool& spool, const std::string& why) {
  return {spool.folder().string(), "", "the print cannot go on with its next line: " + why,
          "see `unicursal resume " + spool.folder().filename().string() + "`"};
}

std::optional<LayerRange> layers_of(const Spool& spool) {
  if (const auto& asked = spool.order().layers) return LayerRange{asked->first, asked->second};
  return std::nullopt;
}

StreamSettings settings_for(const Job& job, const PrintOptions& options) {
  StreamSettings settings;
  settings.profile = job.profile.file;
  settings.pause_heat = options.pause_heat;
  settings.display = job.profile.display;
  return settings;
}

}  // namespace

Print::Print(std::unique_ptr<Production> production, const PrintOptions& options)
    : continues_(false),
      production_(std::move(production)),
      options_(options),
      settings_(settings_for(job(), options)) {
  production_->check();
  production_->begin(settings_.clock, {});
}

Print::Print(Spool spool, const PrintOptions& options)
    : spool_(std::move(spool)),
      continues_(true),
      production_(produce(spool_->job(), layers_of(*spool_))),
      options_(options),
      settings_(settings_for(job(), options)) {
  production_->begin(settings_.clock, spool_->extent());
}

Print::~Print() {
  if (port_ >= 0) close(port_);
}

void Print::connect(std::optional<Leg> leg, const OpenPort& open) {
  Descriptor in_hand(open.descriptor);
  const Profile& profile = job().profile;
  const std::string port = options_.port.value_or(continues_ ? spool_->order().port : profile.port);
  settings_.link = {};  // closes an earlier log
  settings_.link = link_options(profile, options_.log);
  if (in_hand && open.name == port && open.baud == profile.baud) {
    port_ = in_hand.release();
    settings_.link.boot = {};
  } else {
    in_hand.reset();
    port_ = open_port(port, profile.baud, settings_.link);
  }
  port_name_ = port;
  device_ = device_of(port_);
  stable_name_ = stable_name_of(device_);
  if (continues_) {
    settings_.continuation = Continuation{std::move(leg), [this] { production_->catch_up(*spool_); }};
  } else {
    spool_.emplace(Spool::create(options_.spool ? *options_.spool : default_spool_root(), job(),
                                 order_of(*production_, port, device_)));
  }
  if (!awake_) awake_.emplace("printing " + job().file.stem().string());
  settings_.spool = &*spool_;
  chunks_before_ = spool_->extent().chunks;
  source_ = &production_->open(spool_->extent());
}

void Print::reconnect() {
  spool_->look_again();
  if (const auto lost = lost_before(spool_->before())) throw cannot_go_on(*spool_, lost->why);
  if (source_->cancelled()) throw cannot_go_on(*spool_, "it was stopped");
  // A chunk that was made and could not be kept is lost with its session.
  if (chunks_before_ + source_->made() != spool_->extent().chunks)
    throw cannot_go_on(*spool_, "its last lines could not be kept");
  const Profile& profile = job().profile;
  const std::shared_ptr<SerialLog> log = settings_.link.log;
  settings_.link = link_options(profile, {});
  settings_.link.log = log;
  port_ = open_port(port_when_back(), profile.baud, settings_.link);
  if (!awake_) awake_.emplace("printing " + job().file.stem().string());
  settings_.continuation = Continuation{std::nullopt, [] {}};  // the source is where the spool ends
}

// "auto" might find another printer.
const std::string& Print::port_when_back() const {
  if (!stable_name_.empty()) return stable_name_;
  return port_name_ == "auto" ? device_ : port_name_;
}

int Print::take_port() {
  return std::exchange(port_, -1);
}

Session& Print::begin(asio::any_io_executor executor) {
  session_.emplace(std::move(executor), take_port(), *source_, settings_);
  return *session_;
}

void Print::end() {
  session_.reset();
  awake_.reset();
}

void throw_if_failed(const StreamResult& result) {
  if (result.unfit) throw PrinterUnfit(result.reason);
  if (result.ending == Ending::failed) throw PrintError(result.reason);
}

}  // namespace unicursal::host
