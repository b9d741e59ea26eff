// Rows are made again where their facts, their colour or their mark has changed; whatever else would be made is the same.
#include "ui/desktop/view/volume_pictures.h"

#include <algorithm>
#include <utility>

namespace bl::desktop {

namespace {

constexpr Colour kPlaster = 0xffd8dde0u;
// A cellar is paler than its volume: it is no floor area.
constexpr float kPlain = 0.16f, kPale = 0.5f;

// Cellars that are laid open; where there are none of them, the list is as good as empty.
std::size_t open_cellars(const SceneFacts& facts) {
  const auto is_open = [](const CellarFacts& cellar) { return cellar.cell != nullptr; };
  return std::any_of(facts.cellars.begin(), facts.cellars.end(), is_open) ? facts.cellars.size() : 0;
}

}  // namespace

VolumePictures::Marks VolumePictures::marks_of(const Look& look) const {
  Marks marks{look.picks.hovered_node, look.picks.nodes, {}};
  if (look.picks.hovered_link.empty() && look.picks.links.empty()) return marks;
  for (const LinkFacts& link : look.facts.links)
    if (link.id == look.picks.hovered_link || look.picks.links.contains(link.id)) marks.joined.insert({link.from, link.to});
  return marks;
}

ViewVolume VolumePictures::picture_of(const Look& look, std::size_t row) const {
  const VolumeFacts& volume = look.facts.volumes[row];
  ViewVolume shown;
  shown.node = volume.node;
  shown.cell = volume.cell;
  // A little plaster in every colour: the model stays calm beside the things that speak.
  shown.colour = row < look.colours.size() ? mixed(look.colours[row], kPlaster, kPlain) : kPlaster;
  shown.bottom = static_cast<float>(volume.figures.bottom);
  shown.storey = volume.is_ball ? 0 : static_cast<float>(volume.figures.storey_height);
  if (volume.drawn_storeys) {
    shown.bottom = static_cast<float>(volume.drawn_storeys->first);
    shown.storey = static_cast<float>(volume.drawn_storeys->second);
  }
  if (volume.id == marks_.hovered || marks_.joined.contains(volume.node)) shown.flags |= ViewVolume::hovered;
  if (marks_.chosen.contains(volume.id)) shown.flags |= ViewVolume::chosen;
  if (volume.is_edgeless) shown.flags |= ViewVolume::plain;
  if (volume.is_ball) shown.flags |= ViewVolume::dimmed;
  if (!volume.is_dressed || volume.is_ball || !look.has_facades) return shown;
  shown.flags |= ViewVolume::dressed;
  shown.facade = volume.facade;
  return shown;
}

ViewVolume VolumePictures::picture_of(const Look& look, const BodyFacts& body) const {
  ViewVolume shown;
  shown.node = body.node;
  shown.cell = body.cell;
  shown.colour = look.is_dark ? 0xff6d6762u : 0xffc9c5c0u;
  shown.flags = ViewVolume::plain;
  // An assumed height is hatched, so that nobody takes it for a measured one.
  if (body.is_assumed) shown.flags |= ViewVolume::hatched;
  if (marks_.hovered == body.id) shown.flags |= ViewVolume::hovered;
  if (marks_.chosen.contains(body.id)) shown.flags |= ViewVolume::chosen;
  return shown;
}

ViewVolume VolumePictures::picture_of(const Look& look, const CellarFacts& cellar) const {
  ViewVolume shown;
  shown.node = cellar.node;
  shown.cell = cellar.cell;
  const std::size_t row = look.facts.row_of(cellar.node);
  shown.colour = row < look.colours.size() ? mixed(look.colours[row], kPlaster, kPale) : kPlaster;
  shown.bottom = static_cast<float>(cellar.bottom);
  shown.storey = static_cast<float>(cellar.storey_height);
  const std::string& id = look.facts.state->plan->nodes[cellar.node].id;
  if (id == marks_.hovered || marks_.joined.contains(cellar.node)) shown.flags |= ViewVolume::hovered;
  if (marks_.chosen.contains(id)) shown.flags |= ViewVolume::chosen;
  return shown;
}

void VolumePictures::make_all(const Look& look) {
  const SceneFacts& facts = look.facts;
  std::vector<std::pair<ViewVolume, std::uint32_t*>> all;
  rows_.assign(facts.volumes.size(), kNowhere);
  bodies_.assign(look.has_bodies ? facts.urban.bodies.size() : 0, kNowhere);
  cellars_.assign(open_cellars(facts), kNowhere);
  all.reserve(rows_.size() + bodies_.size() + cellars_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (facts.volumes[row].cell) all.emplace_back(picture_of(look, row), &rows_[row]);
  for (std::size_t k = 0; k < bodies_.size(); ++k) all.emplace_back(picture_of(look, facts.urban.bodies[k]), &bodies_[k]);
  for (std::size_t k = 0; k < cellars_.size(); ++k)
    if (facts.cellars[k].cell) all.emplace_back(picture_of(look, facts.cellars[k]), &cellars_[k]);
  if (!bodies_.empty() || !cellars_.empty())
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first.node < b.first.node; });
  std::vector<ViewVolume> items;
  items.reserve(all.size());
  nodes_.clear();
  for (auto& [item, place] : all) {
    *place = static_cast<std::uint32_t>(items.size());
    nodes_.push_back(item.node);
    items.push_back(std::move(item));
  }
  shown_ = listed(std::move(items));
}

// Does every row, every building and every cellar have its item where it had it?
bool VolumePictures::has_same_places(const Look& look) const {
  const SceneFacts& facts = look.facts;
  if (facts.volumes.size() != rows_.size() || (look.has_bodies ? facts.urban.bodies.size() : 0) != bodies_.size()) return false;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (row % VolumeList::kLeaf == 0 && facts.volumes.shares_leaf(volumes_, row / VolumeList::kLeaf)) {
      row += VolumeList::kLeaf - 1;
      continue;
    }
    const VolumeFacts& volume = facts.volumes[row];
    const bool is_somewhere = rows_[row] != kNowhere;
    if ((volume.cell != nullptr) != is_somewhere || (is_somewhere && nodes_[rows_[row]] != volume.node)) return false;
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (nodes_[bodies_[k]] != facts.urban.bodies[k].node) return false;
  if (open_cellars(facts) != cellars_.size()) return false;
  for (std::size_t k = 0; k < cellars_.size(); ++k) {
    const bool is_somewhere = cellars_[k] != kNowhere;
    if ((facts.cellars[k].cell != nullptr) != is_somewhere) return false;
    if (is_somewhere && nodes_[cellars_[k]] != facts.cellars[k].node) return false;
  }
  return true;
}

std::set<std::size_t> VolumePictures::marked_rows(const Look& look, const Marks& marks) const {
  std::set<std::size_t> rows;
  for (const std::uint32_t node : marks.joined) rows.insert(look.facts.row_of(node));
  for (const std::string& id : marks.chosen) rows.insert(look.facts.row_of(look.facts.state->plan->node_index(id)));
  if (!marks.hovered.empty()) rows.insert(look.facts.row_of(look.facts.state->plan->node_index(marks.hovered)));
  rows.erase(look.facts.volumes.size());  // what is no volume
  return rows;
}

void VolumePictures::follow(const Look& look, const Marks& before) {
  const SceneFacts& facts = look.facts;
  ViewVolumes::Draft draft(shown_);
  const auto renew = [&](std::size_t row) {
    if (rows_[row] != kNowhere) draft.put(rows_[row], picture_of(look, row));
  };
  const bool is_every_row = look.has_facades != has_facades_ || look.colours.size() != colours_.size();
  const bool has_same_colours = look.colours == colours_;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const bool is_leaf = row % VolumeList::kLeaf == 0 && !is_every_row && has_same_colours;
    if (is_leaf && facts.volumes.shares_leaf(volumes_, row / VolumeList::kLeaf)) {
      row += VolumeList::kLeaf - 1;
      continue;
    }
    const bool is_other = is_every_row || facts.volumes.item(row) != volumes_.item(row);
    if (is_other || (row < look.colours.size() && look.colours[row] != colours_[row])) renew(row);
  }
  if (marks_ != before)
    for (const Marks* marks : {&before, &std::as_const(marks_)})
      for (const std::size_t row : marked_rows(look, *marks)) renew(row);
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (ViewVolume body = picture_of(look, facts.urban.bodies[k]); !(body == draft[bodies_[k]]))
      draft.put(bodies_[k], std::move(body));
  for (std::size_t k = 0; k < cellars_.size(); ++k)
    if (cellars_[k] != kNowhere)
      if (ViewVolume cellar = picture_of(look, facts.cellars[k]); !(cellar == draft[cellars_[k]]))
        draft.put(cellars_[k], std::move(cellar));
  shown_ = published(std::move(draft));
}

const ViewVolumes& VolumePictures::of(const Look& look) {
  const Marks before = std::exchange(marks_, marks_of(look));
  if (has_same_places(look)) follow(look, before);
  else make_all(look);
  volumes_ = look.facts.volumes;
  if (colours_ != look.colours) colours_ = look.colours;
  has_facades_ = look.has_facades;
  return shown_;
}

}  // namespace bl::desktop
