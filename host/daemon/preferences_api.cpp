// What the page's users choose for this printer, and the camera that they have chosen.
#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/camera.hpp"

namespace unicursal::host {

using nlohmann::json;

namespace {

HttpError without_preferences() {
  return {404, "this daemon keeps no preferences"};
}

}  // namespace

asio::awaitable<Response> Api::show_preferences(Request request) {
  if (!preferences_) throw without_preferences();
  co_return reply(preferences_->shown_to(check_access(request, rules_).right));
}

asio::awaitable<Response> Api::set_preferences(Request request) {
  if (!preferences_) throw without_preferences();
  const Right right = check_access(request, rules_).right;
  json body = read_object(request, {"name", "language", "camera", "presets", "version"});
  co_await preferences_->change(std::move(body), right);
  co_return reply(preferences_->shown_to(right));
}

asio::awaitable<Response> Api::camera(Request) {
  if (!preferences_ || preferences_->values().camera.empty())
    throw HttpError(404, "no camera is set; set the address of its pictures on the page");
  co_return co_await fetch_picture(parse_camera_address(preferences_->values().camera));
}

}  // namespace unicursal::host
