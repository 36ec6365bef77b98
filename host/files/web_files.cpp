#include "host/files/web_files.hpp"

#include <zlib.h>

#include <algorithm>
#include <cassert>

namespace unicursal::host {

const WebFile* web_file(std::string_view name) {
  const auto& all = web_files();
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const WebFile& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string unpacked(const WebFile& file) {
  constexpr int with_gzip_head = 16 + MAX_WBITS;
  std::string packed(file.packed), text;
  char bytes[16 * 1024];
  z_stream stream{};
  [[maybe_unused]] int state = inflateInit2(&stream, with_gzip_head);
  assert(state == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  do {
    stream.next_out = reinterpret_cast<Bytef*>(bytes);
    stream.avail_out = sizeof bytes;
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(bytes, sizeof bytes - stream.avail_out);
  } while (state == Z_OK);
  assert(state == Z_STREAM_END);  // the build has packed it
  inflateEnd(&stream);
  return text;
}

}  // namespace unicursal::host
