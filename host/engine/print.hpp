// One print with everything that a session needs, in the order in which it has to go away. The foreground
// commands and the daemon print through it; a dry run, which keeps no spool, has its own (host/dry_run).
//
//   Print print(produce(load_job("leaf.toml")), {.port = "/dev/ttyUSB0"});
//   print.connect();
//   stream(print.take_port(), print.source(), observer, print.settings());
//
// Making one and connecting it reads files and opens the port, which takes time and may be done in any
// thread; printing belongs to the loop's thread.
#pragma once

#include <asio/any_io_executor.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host/engine/production.hpp"
#include "host/engine/session.hpp"
#include "host/engine/source.hpp"
#include "host/loop/stay_awake.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

struct PrintOptions {
  std::optional<std::string> port;             ///< absent: the profile's, or that of the print that continues
  std::optional<std::filesystem::path> spool;  ///< folder of the prints; absent: the user's
  std::optional<std::filesystem::path> log;    ///< of the serial line
  PauseHeat pause_heat = PauseHeat::keep;
};

/// A port that is open already.
struct OpenPort {
  int descriptor = -1;  ///< −1: none
  std::string name;     ///< as it was asked for
  unsigned baud = 0;
};

class Print {
 public:
  /// A new print: checks that its first layer can be printed, and begins to make it. Throws core::DataError.
  Print(std::unique_ptr<Production> production, const PrintOptions& options);
  /// A print that continues behind what `spool` holds: begins to make the rest.
  Print(Spool spool, const PrintOptions& options);
  ~Print();
  Print(const Print&) = delete;
  Print& operator=(const Print&) = delete;

  /// Opens the port, makes the spool of a new print, and keeps this computer awake from now on. `leg`: as in
  /// Continuation, for a print that continues; call this again after a session that has lost its place.
  /// Throws PortError, core::DataError. `open` is taken over, and used if it is the print's port.
  void connect(std::optional<Leg> leg = {}, const OpenPort& open = {});

  /// After end(), if the session's connection was cut: opens the port again, by whatever name the same
  /// adapter has now, to go on with the next line. Planning has gone on meanwhile. Throws PortError while the
  /// port is not there, and SpoolError if the print cannot go on in this process.
  void reconnect();

  /// Where its printer will be when it is plugged in again: by a name of its adapter, if that has one.
  const std::string& port_when_back() const;

  /// What stream() or a Session takes, after connect(); the port's descriptor once.
  int take_port();
  Source& source() { return *source_; }
  const StreamSettings& settings() const { return settings_; }

  /// From the next session on.
  void follow(LineFollower* follower) { settings_.follower = follower; }
  /// Makes the session; once, on the loop's thread.
  Session& begin(asio::any_io_executor executor);
  Session* session() { return session_ ? &*session_ : nullptr; }
  const Session* session() const { return session_ ? &*session_ : nullptr; }
  /// On the loop's thread, when the session's run() has ended; the rest may then go away in any thread.
  void end();

  const Production& production() const { return *production_; }
  Production& production() { return *production_; }
  const Job& job() const { return production_->job(); }
  /// Whether connect() has come so far; a print that continues has one from the beginning.
  bool has_spool() const { return spool_.has_value(); }
  Spool& spool() { return *spool_; }
  /// The name that `unicursal resume` takes.
  std::string kept_as() const { return spool_->folder().filename().string(); }

 private:
  std::optional<Spool> spool_;
  const bool continues_;
  const std::unique_ptr<Production> production_;
  const PrintOptions options_;
  StreamSettings settings_;
  int port_ = -1;                  ///< until a session has taken it over
  std::string port_name_;          ///< as it was asked for
  std::string device_;             ///< what that was when it was opened
  std::string stable_name_;        ///< of the adapter, in /dev/serial/by-id; may be empty
  std::size_t chunks_before_ = 0;  ///< in the spool when the source was made
  std::optional<StayAwake> awake_;
  KeptSource* source_ = nullptr;  ///< from connect() on
  std::optional<Session> session_;
};

/// Throws PrintError if a print has failed, PrinterUnfit if its printer was refused.
void throw_if_failed(const StreamResult& result);

}  // namespace unicursal::host
