// A server that answers each request with the same bytes, as a camera or a printer of the network would.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace unicursal::test {

class SmallServer {
 public:
  /// `endless`: goes on with zeros until the client has had enough. `silent`: answers nothing.
  struct Answer {
    std::string bytes;
    bool endless = false, silent = false;
  };

  explicit SmallServer(Answer answer) : answer_(std::move(answer)), fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(fd_, 8) != 0 ||
        getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no server");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~SmallServer() {
    shutdown(fd_, SHUT_RDWR);
    thread_.join();
    close(fd_);
  }
  SmallServer(const SmallServer&) = delete;
  SmallServer& operator=(const SmallServer&) = delete;

  int port() const { return port_; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  /// The heads of the requests so far.
  std::vector<std::string> requests() {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 private:
  void serve() {
    for (;;) {
      const int client = accept(fd_, nullptr, nullptr);
      if (client < 0) return;
      std::string head;
      char bytes[4096];
      for (ssize_t size = 1; size > 0 && head.find("\r\n\r\n") == std::string::npos;) {
        size = recv(client, bytes, sizeof bytes, 0);
        if (size > 0) head.append(bytes, static_cast<std::size_t>(size));
      }
      {
        const std::lock_guard lock(mutex_);
        requests_.push_back(head);
      }
      if (answer_.silent)
        recv(client, bytes, 1, 0);  // until the client leaves
      else if (send_all(client, answer_.bytes) && answer_.endless)
        while (send_all(client, std::string(64 * 1024, '\0'))) {
        }
      close(client);
    }
  }
  static bool send_all(int client, const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t sent = send(client, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
      if (sent <= 0) return false;
      done += static_cast<std::size_t>(sent);
    }
    return true;
  }

  const Answer answer_;
  int fd_, port_ = 0;
  std::mutex mutex_;
  std::vector<std::string> requests_;
  std::thread thread_;
};

}  // namespace unicursal::test
