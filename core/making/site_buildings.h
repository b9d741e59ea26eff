// Buildings of the surroundings inside a site: finds them, and keeps or clears them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/import/context.h"

namespace bl::making {

/// Kept buildings stay in the scene, and the site leaves out their ground up to their roofs; cleared ones are left out of the
/// scene.
enum class InsideChoice { unsaid, keep, clear };

/// Asked once where the choice was not given; true clears the buildings. Empty: nobody can be asked.
using AskToClear = std::function<bool(std::size_t buildings, const std::string& site)>;

/// The boundaries of a scene in plan, and the buildings of an import that meet them.
/// A building counts as inside where more of its footprint lies in the site than drawings are inexact by. It is judged as a
/// whole, with all of its parts: where less than half of it is inside, it is a neighbour that reaches in, and stays in any case.
class SiteBuildings {
 public:
  SiteBuildings(const Scene& scene, const Registry& registry, InsideChoice choice, AskToClear ask);

  /// Of all buildings of a file, before they are made nodes.
  void judge(const importing::Context& context);
  /// Is that building of the file left out?
  bool is_cleared(std::size_t building) const;
  /// Adds a detail to the row of a building that stays, and makes its site leave out its ground. `is_changed`: the node is new,
  /// or another than before.
  void keep(std::size_t building, const importing::ContextBuilding& made, const std::string& node, bool is_changed,
            importing::ImportReport& report);
  static constexpr const char* kClearedReason = "it stands inside the site, which is cleared";

  /// Makes sites leave out the streets and areas of these kinds (`kClearGrounds`) that reach into them, up to their whole height.
  void clear_grounds(const importing::Context& context, const std::set<std::string>& kinds, bool takes_all_streets);
  /// The site that leaves out an area of the file; empty: none.
  std::string site_without(const importing::ContextArea& area) const;

  /// Was any building left out?
  bool has_cleared() const;
  /// The new values of the sites' exclusions, by node.
  std::vector<std::pair<std::string, Table>> exclusions() const;
  /// Notices about the buildings, after all files.
  std::vector<std::string> notes() const;

 private:
  struct Site {
    std::string id;
    std::vector<std::vector<geometry::Ring>> grounds;  // each an outline with its holes
    double bottom = 0, top = 0;
    Table rows, rows_before;                              // its exclusions
    std::map<std::string, std::size_t> grounds_left_out;  // by kind
    std::set<std::size_t> kept, reaching;                 // whole buildings that stay, by their number in `judged_`
    std::size_t cleared = 0;
  };
  struct Stay {
    std::size_t site = 0;
    double share = 0;       // [ratio] of the footprint that lies inside
    std::size_t whole = 0;  // the number of its whole building
    bool is_own = false;    // the site is its place
    bool is_cleared = false;
  };

  double inside(const Site& site, const importing::ContextBuilding& building) const;
  bool leave_out(Site& site, const std::string& name, const std::string& use, const std::vector<geometry::Ring>& rings);
  bool clears(std::size_t buildings, const std::string& site);

  std::vector<Site> sites_;
  std::size_t judged_ = 0;  // whole buildings of all files
  InsideChoice choice_;
  bool is_assumed_ = false;
  AskToClear ask_;
  std::map<std::size_t, std::vector<Stay>> stays_;  // by building of the file
  std::map<std::string, std::string> left_out_;     // areas of the file, and the site without them
  std::vector<std::string> ground_notes_;
};

}  // namespace bl::making
