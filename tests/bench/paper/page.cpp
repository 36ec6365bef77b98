#include "tests/bench/paper/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "tests/bench/paper/charts.hpp"
#include "tests/bench/paper/methods.hpp"

namespace unicursal::bench {
namespace {

constexpr const char* style = R"(
:root{color-scheme:light}
body{font:16px/1.5 system-ui,sans-serif;color:#1c2430;background:#fff;max-width:1240px;margin:24px auto;padding:0 20px}
h1{font-size:28px;margin-bottom:4px}h2{margin-top:44px;border-top:2px solid #d8dee6;padding-top:18px}
table{border-collapse:collapse;margin:14px 0;font-size:14px}
th,td{padding:5px 10px;text-align:right;border-bottom:1px solid #e2e7ee}
th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #8b97a8;vertical-align:bottom}
.claims td,.claims th{text-align:left}.claims td{vertical-align:top}.claims td:first-child{white-space:nowrap;font-weight:600}
.yes{color:#146c37}.no{color:#b3261e}.best{font-weight:700}.dim{color:#5a6675}
.row{display:grid;grid-template-columns:repeat(4,1fr);gap:14px}figure{margin:0}
figure img{width:100%;height:auto;border:1px solid #e2e7ee;background:#fff}figcaption{font-size:13px;color:#5a6675}
.charts{display:flex;flex-wrap:wrap;align-items:flex-start;gap:24px}svg{background:#fafbfc}
.n{font-size:12px}.t{font-size:14px;font-weight:600}.e{text-anchor:end}.m{text-anchor:middle}
.g{stroke:#dfe4ea}.one{stroke:#b3261e;stroke-dasharray:3 3}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<'    ? "&lt;"
              : c == '>'  ? "&gt;"
              : c == '&'  ? "&amp;"
              : c == '\'' ? "&#39;"
                          : std::string(1, c);
  }
  return result;
}

std::string colour_of_method(const std::string& method) {
  if (method == "ours") return "#2a6fb0";
  if (method == "zigzag") return "#8a6d1d";
  if (method == "fermat") return "#2f7d4f";
  return "#a03c7c";
}

/// A figure in the table of a part. `less`: a smaller value is better.
struct Row {
  std::string head;
  std::string format;
  std::optional<double> (*value)(const Figures&);
  bool less = true;
};

std::optional<double> number(std::size_t n) {
  return static_cast<double>(n);
}

const std::vector<Row>& rows_of_figures() {
  using F = const Figures&;
  static const std::vector<Row> all{
      {"travels", "{:.0f}", [](F f) { return number(f.travels); }},
      {"length of travels, mm", "{:.0f}", [](F f) { return std::optional(f.travel_length); }},
      {"crossings of materials' borders", "{:.0f}", [](F f) { return number(f.crossings); }},
      {"segments that meet or lie outside", "{:.0f}", [](F f) { return number(f.meetings + f.outside); }},
      {"mean spacing, mm", "{:.3f}", [](F f) { return std::optional(f.spacing.mean); }, false},
      {"CV of the spacing, on a lattice", "{:.3f}", [](F f) { return std::optional(f.spacing.variation); }},
      {"CV of the spacing, exact diagram", "{:.3f}", [](F f) { return f.exact_variation; }},
      {"E, on a lattice", "{:.4f}", [](F f) { return std::optional(f.coverage); }},
      {"E, exact diagram", "{:.4f}", [](F f) { return f.exact_coverage; }},
      {"farther than 0.75 bead widths, % of the area", "{:.2f}",
       [](F f) { return std::optional(100 * f.bare); }},
      {"gaps with one width, % of the area", "{:.2f}",
       [](F f) { return std::optional(100 * f.constant.gaps); }},
      {"overfill with one width, %", "{:.2f}", [](F f) { return std::optional(100 * f.constant.overfill); }},
      {"gaps with own areas, %", "{:.2f}", [](F f) { return std::optional(100 * f.own.gaps); }},
      {"overfill with own areas, %", "{:.2f}", [](F f) { return std::optional(100 * f.own.overfill); }},
      {"squared angle to the asked directions, rad²", "{:.3f}", [](F f) { return f.alignment; }},
      {"E_iso of the isotropic zones, rad²", "{:.5f}", [](F f) { return f.isotropy; }},
      {"iterations (ours: sweeps of the cycle and steps of fairing)", "{:.0f}",
       [](F f) -> std::optional<double> {
         if (f.iterations == 0) return std::nullopt;
         return number(f.iterations);
       },
       false},
      {"processor time, s", "{:.2f}", [](F f) { return std::optional(f.seconds); }}};
  return all;
}

bool has_best(const PartReport& part, const Row& figure_row, double value) {
  return figure_row.less && part.methods.size() > 1 &&
         std::none_of(part.methods.begin(), part.methods.end(), [&](const auto& m) {
           const auto other = figure_row.value(m.second);
           return other && *other < value;
         });
}

/// One row for each figure, one column for each method.
std::string table_of(const PartReport& part) {
  std::vector<const Figures*> methods;
  std::string html = "<table><thead><tr><th></th>";
  for (const std::string_view name : method_names) {
    const auto found = part.methods.find(std::string(name));
    if (found == part.methods.end()) continue;
    methods.push_back(&found->second);
    html += "<th>" + escaped(title_of(name)) + (found->second.finished ? "" : "<br>(given up)") + "</th>";
  }
  html += "</tr></thead><tbody>";
  for (const Row& figure_row : rows_of_figures()) {
    std::string row;
    bool any = false;
    for (const Figures* figures : methods) {
      const auto value = figure_row.value(*figures);
      any = any || value;
      row += value && has_best(part, figure_row, *value) ? "<td class='best'>" : "<td>";
      row += value ? fmt::format(fmt::runtime(figure_row.format), *value) : "";
      row += "</td>";
    }
    if (any) html += "<tr><td>" + figure_row.head + "</td>" + row + "</tr>";
  }
  return html + "</tbody></table>";
}

std::string picture(const std::string& file, const std::string& caption) {
  if (file.empty()) return "<figure></figure>";
  return fmt::format(
      "<figure><a href='{0}'><img src='{0}' alt='{1}' loading='lazy'></a><figcaption>{1}"
      "</figcaption></figure>",
      escaped(file), escaped(caption));
}

std::string section_of(const PartReport& part) {
  std::string html = fmt::format("<h2 id='{}'>{}</h2><p>{:.0f} mm², {} island{}, bead width {:.3f} mm.</p>",
                                 escaped(part.part.name), escaped(part.part.title), part.part.area(),
                                 part.part.layer.islands.size(),
                                 part.part.layer.islands.size() == 1 ? "" : "s", part.part.width());
  html += table_of(part);
  std::string lines, gaps, bars;
  for (const std::string_view name : method_names) {
    const auto found = part.methods.find(std::string(name));
    if (found == part.methods.end()) continue;
    const Figures& f = found->second;
    const std::string title = title_of(name);
    lines += picture(f.lines_picture, title + (f.travels > 0 ? "; travels in red" : ""));
    gaps += picture(f.gaps_picture, title + ": as laid with one bead width");
    bars += "<figure>" + histogram(f.spacing.shares, Spread::bin, colour_of_method(f.method)) +
            fmt::format("<figcaption>{}: spacing in bead widths, CV {:.3f}</figcaption></figure>",
                        escaped(title), f.spacing.variation);
  }
  return html + "<div class='row'>" + lines + "</div><div class='row'>" + gaps + "</div><div class='row'>" +
         bars + "</div>";
}

std::string table_of(const std::vector<Claim>& claims) {
  const auto holding = std::count_if(claims.begin(), claims.end(), [](const Claim& c) { return c.holds(); });
  std::string html = fmt::format(
      "<h2 id='claims'>Claims</h2><p>{} of {} hold on what was measured here.</p>"
      "<table class='claims'><thead><tr><th></th><th>claim</th><th>said by</th>"
      "<th>where it does not hold</th></tr></thead><tbody>",
      holding, claims.size());
  for (const Claim& claim : claims) {
    std::string against;
    for (const std::string& one : claim.against) against += escaped(one) + "<br>";
    html += fmt::format(
        "<tr><td class='{}'>{}</td><td>{}</td><td class='dim'>{}</td><td>{}</td></tr>",
        claim.holds() ? "yes" : "no",
        claim.holds() ? "holds" : fmt::format("not in {} of {}", claim.against.size(), claim.cases),
        escaped(claim.said), escaped(claim.source), against);
  }
  return html + "</tbody></table>";
}

std::string spacing_section(const Report& report) {
  if (report.spacing.empty()) return "";
  Series mean{"mean of the shapes", "#2a6fb0", {}, {}}, least{"least", "#8b97a8", {}, {}, true},
      most{"most", "#8b97a8", {}, {}, true};
  std::string rows;
  for (const SpacingAgainstD& s : report.spacing) {
    mean.x.push_back(s.d), mean.y.push_back(s.mean);
    least.x.push_back(s.d), least.y.push_back(s.least);
    most.x.push_back(s.d), most.y.push_back(s.most);
    rows +=
        fmt::format("<tr><td>{:.2f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.2f}</td></tr>",
                    s.d, s.mean, s.least, s.most, s.mean / s.d);
  }
  std::string html =
      "<h2 id='figure-13'>Spacing against d (Figure 13)</h2><div class='charts'>" +
      line_chart({"Spacing of the smoothed cycle", "d, mm", "area ÷ length, mm"}, {mean, least, most}) +
      "<table><thead><tr><th>d, mm</th><th>mean, mm</th><th>least</th><th>most</th>"
      "<th>mean ÷ d</th></tr></thead><tbody>" +
      rows +
      "</tbody></table></div><p class='dim'>The paper: 30 models, within ± 0.1 mm of "
      "each other. The axes of its figure are in the picture only.</p>";
  if (report.held)
    html += fmt::format(
        "<p>This project holds the length instead. Asked for {:.2f} mm, the spacing of whole "
        "plans on the same shapes is {:.3f} to {:.3f} bead widths; the worst CV is {:.3f}. Shapes that "
        "could not be planned: {}.</p>",
        report.held_width, report.held->least, report.held->most, report.held->worst_variation,
        report.held->failed);
  return html;
}

std::string cost_section(const Report& report) {
  if (report.costs.empty()) return "";
  Series shuffle{"one call of Shuffle", "#2a6fb0", {}, {}}, step{"one step of fairing", "#a03c7c", {}, {}};
  std::string rows;
  for (const CostAtD& c : report.costs) {
    if (c.nodes == 0) continue;
    shuffle.x.push_back(c.d), shuffle.y.push_back(c.shuffle);
    step.x.push_back(c.d), step.y.push_back(c.fairing_step);
    rows += fmt::format(
        "<tr><td>{:.2f}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.4f}</td><td>{}</td></tr>", c.d,
        c.nodes, c.graph, c.shuffle, c.fairing_step, c.fairing_steps);
  }
  return "<h2 id='figure-16'>Time against d (Figure 16)</h2><p>" + escaped(report.cost_part) +
         fmt::format(", one processor. Shuffle ∝ N^{:.2f}, fairing ∝ N^{:.2f} for N nodes.</p>",
                     exponent(report.costs, &CostAtD::shuffle),
                     exponent(report.costs, &CostAtD::fairing_step)) +
         "<div class='charts'>" + line_chart({"Processor time", "d, mm", "s"}, {shuffle, step}, true) +
         "<table><thead><tr><th>d, mm</th><th>nodes</th><th>graph, s</th><th>Shuffle, s</th>"
         "<th>step of fairing, s</th><th>steps</th></tr></thead><tbody>" +
         rows +
         "</tbody></table></div><p class='dim'>The paper: roughly polynomial in d; Shuffle is O(N²) at "
         "worst, an iteration of fairing O(N log N) (§4.3). Its values are in the picture only.</p>";
}

std::string operations_section(const Report& report) {
  std::string rows;
  for (const PartReport& p : report.parts) {
    const Joining& j = p.joining;
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.1f} %</td><td>{}</td><td>{}</td>"
        "<td>{:.1f} %</td></tr>",
        escaped(p.part.title), j.reconnected, j.doubled, 100 * doubled_share(j.reconnected, j.doubled),
        j.plain_reconnected, j.plain_doubled, 100 * doubled_share(j.plain_reconnected, j.plain_doubled));
  }
  struct Published {
    const char* model;
    std::size_t with, with_doubled, without, without_doubled;
  };
  for (const Published& p :
       {Published{"hourglass", 1323, 0, 558, 768}, Published{"android", 3589, 16, 1421, 2186},
        Published{"balljoint", 1552, 47, 649, 955}}) {
    rows += fmt::format(
        "<tr class='dim'><td>paper, {} (all layers)</td><td>{}</td><td>{}</td><td>{:.1f} %</td>"
        "<td>{}</td><td>{}</td><td>{:.1f} %</td></tr>",
        p.model, p.with, p.with_doubled, 100 * doubled_share(p.with, p.with_doubled), p.without,
        p.without_doubled, 100 * doubled_share(p.without, p.without_doubled));
  }
  std::string html =
      "<h2 id='table-1'>How cycles are joined (Table 1)</h2><table><thead><tr><th>part</th>"
      "<th>refined:<br>split-and-reconnect</th><th>doubled<br>edges</th><th>share</th>"
      "<th>not refined:<br>split-and-reconnect</th><th>doubled<br>edges</th><th>share</th>"
      "</tr></thead><tbody>" +
      rows +
      "</tbody></table><p class='dim'>Without refinement, a face whose sides belong to cycles in turns, "
      "each to another, is turned over here. That joins up to three cycles at once, where Figure 7 joins "
      "two across a quadrilateral, so fewer are left for doubled edges than in the paper.</p>";
  rows.clear();
  for (const PartReport& p : report.parts) {
    const core::LocalOperations& o = p.operations;
    if (o.looks == 0) continue;
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
      return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
    };
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{} ({:.1f} %)</td><td>{} ({:.1f} %)</td></tr>",
                        escaped(p.part.title), o.looks, o.found, share(o.found, o.looks), o.accepted,
                        share(o.accepted, o.found));
  }
  return html +
         "<p>Local operations of the optimiser (§3.3.3). Parts whose directions are all asked for have "
         "none, since they are filled by stripes.</p><table><thead><tr><th>part</th><th>attempts</th>"
         "<th>an operation fits</th><th>accepted</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

std::string stage_section(const Report& report) {
  std::string rows;
  for (const PartReport& p : report.parts) {
    const bool brain = p.part.name.starts_with("brain");
    rows += fmt::format(
        "<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td class='dim'>{}</td></tr>",
        escaped(p.part.title), p.graph, p.cycle, p.fairing, brain ? "paper, Brain: 4, 8, 12 s" : "");
  }
  return "<h2 id='table-2'>Time of the stages (Table 2)</h2><table><thead><tr><th>part, one layer</th>"
         "<th>init, s</th><th>combinatorial, s</th><th>geometric, s</th><th></th></tr></thead><tbody>" +
         rows +
         "<tr class='dim'><td>paper, Leaf of 146 × 160 mm (another "
         "leaf)</td><td>54</td><td>73</td><td>242</td>"
         "<td></td></tr><tr class='dim'><td>paper, CuteOcto, 282 "
         "layers</td><td>9</td><td>462</td><td>220</td>"
         "<td></td></tr></tbody></table><p class='dim'>Processor time here; the paper's is time on a Core "
         "i7-10750H, with 12 threads in the combinatorial stage.</p>";
}

std::string objectives_section(const Report& report) {
  if (report.objectives.empty()) return "";
  std::string bars;
  for (const ObjectiveReport& o : report.objectives) {
    bars += "<figure>" + histogram(o.figures.spacing.shares, Spread::bin, "#2a6fb0") +
            fmt::format("<figcaption>{}: mean {:.3f} mm, CV {:.3f}</figcaption></figure>", escaped(o.name),
                        o.figures.spacing.mean, o.figures.spacing.variation);
  }
  std::string pictures;
  for (const ObjectiveReport& o : report.objectives) pictures += picture(o.figures.lines_picture, o.name);
  return "<h2 id='figure-14'>Spacing under the objectives (Figure 14)</h2><div class='row'>" + pictures +
         "</div><div class='row'>" + bars +
         "</div><p class='dim'>The paper: means within 0.05 mm of each other, the least variance under "
         "anisotropy.</p>";
}

std::string smoothing_section(const Report& report) {
  if (!report.smoothing) return "";
  return "<h2 id='figure-15'>The smoothing term (Figure 15)</h2><div class='row'>" +
         picture(report.smooth.lines_picture, "with it") + picture(report.unsmooth.lines_picture, "without") +
         fmt::format(
             "</div><p>One vertex in a hundred turns by more than {:.2f} rad with it, {:.2f} rad without; "
             "E is {:.4f} and {:.4f}.</p>",
             report.smoothing->sharpest_with, report.smoothing->sharpest_without, report.smooth.coverage,
             report.unsmooth.coverage);
}

std::string convergence_section(const Report& report) {
  if (report.convergence.empty()) return "";
  std::string rows;
  for (const Convergence& c : report.convergence) {
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}{}</td><td class='dim'>{}</td></tr>",
                        escaped(c.part), c.fairing_steps, c.growth_steps,
                        c.growth_finished ? "" : " (given up)", escaped(c.published));
  }
  return "<h2 id='figure-26'>Iterations against growth (Figure 26)</h2><table><thead><tr><th>part</th>"
         "<th>steps of fairing</th><th>steps of growth</th><th></th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

constexpr const char* intro =
    "<p>What Bedel et al. 2022 compare and claim (§5.1, §5.2, Figures 13 to 16 and 22 to 26, Tables 1 and "
    "2), "
    "measured again with this project's curves. A value of the paper's stands in grey beside ours; figures "
    "whose "
    "values are in a picture only are named, not read off. The zigzag, the connected Fermat spirals of Zhao "
    "et "
    "al. 2016 and the growth of Pedersen and Singh 2006 were written plainly for this page; the comments in "
    "tests/bench/paper say where they simplify.</p><p>All methods are measured alike: each point of the "
    "island "
    "belongs to the nearest line, and spacing is that area ÷ length over windows of one bead width. Straight "
    "parallel rows have E = 0.0833. In the simulator, <em>one width</em> gives every method the same "
    "plastic, "
    "laid evenly along its lines; <em>own areas</em> gives each segment the plastic of its area. Bold is "
    "the best of a row. Travels between islands count for no method.</p>";

}  // namespace

void write_page(const std::filesystem::path& folder, const Report& report, const std::vector<Claim>& claims) {
  const std::filesystem::path path = folder / "index.html";
  std::ofstream file(path);
  file << "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
          "content='width=device-width'><title>The paper's comparisons, reproduced</title><style>"
       << style << "</style></head><body><h1>The paper's comparisons, reproduced</h1>" << intro
       << fmt::format("<p class='dim'>Measured in {:.0f} s.</p>", report.seconds) << table_of(claims);
  for (const PartReport& part : report.parts) file << section_of(part);
  file << convergence_section(report) << spacing_section(report) << objectives_section(report)
       << smoothing_section(report) << cost_section(report) << operations_section(report)
       << stage_section(report) << "</body></html>\n";
  file.close();
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
}

}  // namespace unicursal::bench
