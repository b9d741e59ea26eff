// What all drawings of a report share: their frame, their type, and the order of labels.
#include <algorithm>

#include "core/drawing/markup.h"
#include "core/drawing/pictures.h"

namespace bl::drawing {

namespace {

// Type is kept inside each drawing, so that one taken out of the page still looks the same.
constexpr std::string_view kStyle =
    "text{font-family:system-ui,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif;fill:#21262f;text-anchor:middle}"
    ".name,.figure,.short{paint-order:stroke;stroke:#fcfbf8;stroke-width:3px;stroke-linejoin:round;stroke-opacity:.82}"
    ".name{font-size:11.5px;font-weight:600}.figure{font-size:10px}.short{font-size:9.5px;font-weight:600;stroke-width:2px}"
    ".start{text-anchor:start}.end{text-anchor:end}"
    ".leader{stroke:#21262f;stroke-width:.7;fill:none}.dot{fill:#21262f;stroke:#fcfbf8;stroke-width:.8}";

}  // namespace

void open_picture(Markup& svg, double width, double height, const std::string& id, const std::string& title,
                  const std::string& description) {
  svg.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                   {"viewBox", "0 0 " + pixels(width) + " " + pixels(height)},
                   {"role", "img"},
                   {"aria-labelledby", id + "-title " + id + "-text"}});
  svg.element("title", title, {{"id", id + "-title"}}).element("desc", description, {{"id", id + "-text"}});
  svg.open("style").raw(kStyle).close();
  svg.leaf("rect", {{"width", pixels(width)}, {"height", pixels(height)}, {"fill", hex(kPaper)}});
}

std::string empty_picture(const std::string& id, const std::string& title, const std::string& sentence) {
  Markup svg;
  open_picture(svg, 1000, 120, id, title, sentence);
  svg.element("text", sentence, {{"x", "500"}, {"y", "64"}, {"class", "name"}});
  svg.close();
  return svg.str();
}

std::vector<const reading::VolumeRow*> by_size(const reading::ReportModel& model) {
  std::vector<const reading::VolumeRow*> rows;
  for (const reading::VolumeRow& volume : model.volumes) rows.push_back(&volume);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const reading::VolumeRow* a, const reading::VolumeRow* b) { return a->volume > b->volume; });
  return rows;
}

}  // namespace bl::drawing
