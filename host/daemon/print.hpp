// One job's print by a daemon: everything that a session needs, in the order in which it must go away.
// Preparing reads files and opens the port, which takes its time; printing belongs to the loop's thread.
#pragma once

#include <asio/any_io_executor.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host/engine/prepared_job.hpp"
#include "host/engine/run.hpp"
#include "host/engine/session.hpp"
#include "host/lookahead/lookahead.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

struct PrintPlan {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;  ///< instead of the job's
  std::optional<LayerRange> layers;
  std::optional<std::string> port;  ///< instead of the profile's
  bool own_port = false;            ///< never the port of the job's profile: an upload may say anything
  std::optional<std::filesystem::path> spool;  ///< folder of the prints
  PauseHeat pause_heat = PauseHeat::keep;
};

class Print {
 public:
  /// Reads, checks, begins to plan, opens the port and the spool. From any thread. Throws core::DataError,
  /// PortError.
  explicit Print(const PrintPlan& plan);
  ~Print();
  Print(const Print&) = delete;
  Print& operator=(const Print&) = delete;

  /// Once, on the loop's thread.
  Session& begin(asio::any_io_executor executor);
  Session* session() { return session_ ? &*session_ : nullptr; }
  const Session* session() const { return session_ ? &*session_ : nullptr; }
  /// On the loop's thread, when its run() has ended; the rest may then go away anywhere.
  void end();

  const PreparedJob& prepared() const { return prepared_; }
  /// As `unicursal resume` calls it.
  std::string kept_as() const { return spool_->folder().filename().string(); }

 private:
  StreamSettings settings_;
  const PreparedJob prepared_;
  Run run_;
  Lookahead lookahead_;
  int port_ = -1;  ///< until the session has taken it over
  std::optional<Spool> spool_;
  PlannedSource source_;
  std::optional<Session> session_;
};

}  // namespace unicursal::host
