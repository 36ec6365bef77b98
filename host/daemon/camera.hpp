// One picture of a camera in the network, which the daemon fetches for the page: a browser may not show
// pictures of other computers in it, and the camera need not be reachable for the browser.
//
// The daemon's request could be turned against other services of its network (server-side request forgery).
// So only the owner's token may set the address; only http:// is asked, with GET, without following redirects
// and without anything of the client's request; and only an answer that begins as a JPEG or PNG file is
// passed on.
#pragma once

#include <asio/awaitable.hpp>
#include <chrono>
#include <cstddef>
#include <string>

#include "host/http/http_message.hpp"

namespace unicursal::host {

inline constexpr std::size_t longest_camera_address = 1024;      ///< bytes
inline constexpr std::size_t largest_picture = 4 * 1024 * 1024;  ///< bytes
inline constexpr std::chrono::seconds longest_exposure{5};       ///< for the whole answer

struct CameraAddress {
  std::string host;  ///< a name or an address, "fe80::1" without brackets
  std::string port = "80";
  std::string target;  ///< "/snapshot.jpg?size=2"
};

/// Throws HttpError 422 if it is not of the form http://HOST[:PORT]/PATH. Passwords in it are refused.
CameraAddress parse_camera_address(const std::string& address);

/// Fetches one picture. Throws HttpError 502, 503 if too many pictures are being fetched, or 504. Errors do
/// not hold the address.
asio::awaitable<Response> fetch_picture(CameraAddress address,
                                        std::chrono::milliseconds patience = longest_exposure);

}  // namespace unicursal::host
