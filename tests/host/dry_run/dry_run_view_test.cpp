#include "host/dry_run/dry_run_view.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "host/files/web_files.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("No name in the page of a dry run can become markup, and all come through") {
  const std::string name = "</script><img src=x onerror=alert(1)><!--<script>&amp;\xe2\x80\xae";
  const json view = {{"job", name}, {"printer", name + "\xff"}};
  const std::string page = view_html(view);
  CHECK(count_of(page, "<img") == 0);
  CHECK(count_of(page, "<!--") == 0);
  CHECK(count_of(page, "</script>") == 2);
  const std::size_t begin = page.find('{');
  const json read = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  CHECK(read["job"] == name);
  CHECK(read["printer"].get<std::string>().starts_with(name));
}

TEST_CASE("The page of a dry run is written with its script and style, and an older one is removed") {
  const test::TempFolder folder;
  write_view(folder.path(), {{"job", "a"}});
  for (const char* name : {"index.html", "viewer.js", "viewer.css"})
    CHECK(std::filesystem::exists(folder / name) == !web_files().empty());
  folder.write("index.html", "of an older run");
  folder.write("part.png", "a picture");
  remove_view(folder.path());
  CHECK_FALSE(std::filesystem::exists(folder / "index.html"));
  CHECK(std::filesystem::exists(folder / "part.png"));
}

}  // namespace unicursal::host
