#include "host/daemon/octoprint_push.hpp"

#include <algorithm>
#include <asio/steady_timer.hpp>
#include <cctype>
#include <chrono>

#include "host/daemon/api_body.hpp"
#include "host/daemon/octoprint.hpp"
#include "host/daemon/secret.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr auto interval = 500ms;  ///< between two `current`, if the client asks for no other
constexpr int slowest = 100;      ///< of these intervals

json connected() {
  return {{"connected",
           {{"version", octo::spoken_version},
            {"display_version", octo::spoken_version},
            {"branch", nullptr},
            {"python_version", nullptr},
            {"plugin_hash", ""},
            {"config_hash", ""},
            {"debug", false},
            {"safe_mode", nullptr},
            {"online", nullptr}}}};
}

std::string text_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// What a client knows, and has yet to be sent.
class Push : public std::enable_shared_from_this<Push> {
 public:
  Push(EventStream& client, Daemon& daemon, const PushSessions& sessions)
      : client_(client.weak_from_this()), daemon_(daemon), sessions_(sessions), timer_(client.executor()) {}

  bool open() const {
    const auto client = client_.lock();
    return client && client->open();
  }
  void begin(bool proven);
  void take(const json& event);

 private:
  void hear(const std::string& text);
  void follow();
  void send(const json& message) {
    if (const auto client = client_.lock()) client->send(text_of(message));
  }
  void send_event(const char* type, json payload) {
    send({{"event", {{"type", type}, {"payload", std::move(payload)}}}});
  }
  void send_soon();
  void follow_state();
  void follow_job(const json& job);
  json now() const;

  const std::weak_ptr<EventStream> client_;  ///< it owns this object until it is closed
  Daemon& daemon_;
  const PushSessions& sessions_;
  asio::steady_timer timer_;
  bool follows_ = false, waits_ = false;
  int throttle_ = 1;
  std::chrono::steady_clock::time_point next_{};
  std::string state_;  ///< that the client knows of
};

/// To the daemon it is one of its followers.
class PushFollower final : public Follower {
 public:
  explicit PushFollower(std::shared_ptr<Push> push) : push_(std::move(push)) {}
  bool open() const override { return push_->open(); }
  bool follows_line() const override { return false; }
  void send(const std::string& event) override { push_->take(json::parse(event, nullptr, false)); }

 private:
  std::shared_ptr<Push> push_;
};

void Push::begin(bool proven) {
  send(connected());
  client_.lock()->on_text([self = shared_from_this()](const std::string& text) { self->hear(text); });
  if (proven) follow();
}

/// {"auth": "NAME:SESSION"}, {"throttle": 2}, or what is not known here and left aside.
void Push::hear(const std::string& text) {
  if (is_deeper_than(text, deepest_body)) return;
  const json said = json::parse(text, nullptr, false);
  if (!said.is_object()) return;
  if (const auto throttle = said.find("throttle"); throttle != said.end() && throttle->is_number())
    throttle_ = static_cast<int>(std::clamp(throttle->get<double>(), 1.0, double(slowest)));
  const auto auth = said.find("auth");
  if (auth == said.end() || !auth->is_string() || follows_) return;
  if (!sessions_.knows(auth->get<std::string>())) {
    send({{"reauthRequired", {{"reason", "stale"}}}});
    return;
  }
  if (const auto client = client_.lock(); client && client->admit()) follow();
}

void Push::follow() {
  follows_ = true;
  const json status = daemon_.status();
  state_ = octo::state_text(status, daemon_.port_exists());
  send({{"history", now()}});
  daemon_.join(std::make_unique<PushFollower>(shared_from_this()));
}

/// `event`: one of our own (API.md).
void Push::take(const json& event) {
  if (!event.is_object()) return;
  follow_state();
  if (const auto job = event.find("job"); job != event.end() && job->is_object()) follow_job(*job);
  send_soon();
}

void Push::follow_state() {
  const std::string before = state_;
  state_ = octo::state_text(daemon_.status(), daemon_.port_exists());
  if (state_ == before) return;
  std::string id = state_;
  for (char& sign : id) sign = static_cast<char>(std::toupper(static_cast<unsigned char>(sign)));
  send_event("PrinterStateChanged", {{"state_id", id}, {"state_string", state_}});
  const json file = octo::job(daemon_.status(), nullptr, true)["job"]["file"];
  if (state_ == "Paused") send_event("PrintPaused", file);
  if (state_ == "Printing" && (before == "Paused" || before == "Resuming")) send_event("PrintResumed", file);
}

void Push::follow_job(const json& job) {
  const std::string state = job.value("state", ""), name = job.value("job", "");
  const std::string shown = local_name(name).value_or(name);
  const json file = {{"name", shown}, {"path", shown}, {"origin", "local"}};
  if (state == "preparing") send_event("PrintStarted", file);
  if (state == "done") send_event("PrintDone", file);
  if (state == "stopped") send_event("PrintCancelled", file);
  if (state != "stopped" && state != "failed" && state != "interrupted") return;
  json failed = file;
  failed["reason"] = state == "stopped" ? "cancelled" : "error";
  failed["error"] = job.value("reason", "");
  send_event("PrintFailed", std::move(failed));
}

/// A `current` now, or as soon as the client wants the next one.
void Push::send_soon() {
  if (waits_) return;
  waits_ = true;
  timer_.expires_at(next_);
  timer_.async_wait([self = shared_from_this()](const asio::error_code& cut) {
    self->waits_ = false;
    if (cut || !self->open()) return;
    self->next_ = std::chrono::steady_clock::now() + interval * self->throttle_;
    self->send({{"current", self->now()}});
  });
}

json Push::now() const {
  const json status = daemon_.status();
  const bool there = daemon_.port_exists();
  const json printer = octo::printer(status, there), job = octo::job(status, daemon_.queue().next(), there);
  const auto time =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  json temperatures = json::array();
  if (!printer["temperature"].empty()) {
    temperatures.push_back(printer["temperature"]);
    temperatures[0]["time"] = static_cast<std::int64_t>(time);
  }
  return {{"state", printer["state"]}, {"job", job["job"]},         {"progress", job["progress"]},
          {"currentZ", nullptr},       {"temps", temperatures},     {"offsets", json::object()},
          {"logs", json::array()},     {"messages", json::array()}, {"busyFiles", json::array()},
          {"serverTime", time}};
}

}  // namespace

std::string PushSessions::open() {
  if (sessions_.size() == most) sessions_.pop_front();
  return sessions_.emplace_back(random_token());
}

bool PushSessions::knows(const std::string& auth) const {
  const std::string given = auth.substr(auth.rfind(':') + 1);
  return std::any_of(sessions_.begin(), sessions_.end(),
                     [&](const std::string& one) { return is_same_secret(one, given); });
}

void push_to(EventStream& client, bool proven, Daemon& daemon, const PushSessions& sessions) {
  std::make_shared<Push>(client, daemon, sessions)->begin(proven);
}

}  // namespace unicursal::host
