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
#include "core/making/site.h"

namespace bl::making {

/// Kept buildings stay in the scene, and the site leaves out their ground up to their roofs; cleared ones are left out of the
/// scene.
enum class InsideChoice { unsaid, keep, clear };

/// Asked once where the choice was not given; true clears the buildings. Empty: nobody can be asked.
using AskToClear = std::function<bool(std::size_t buildings, const std::string& site)>;

/// Where streets and areas come from, by which an import again knows what it left out before.
struct GroundSource {
  std::string name;
  bool has_lasting_ids = false;  ///< ids of elements hold beyond the source
};

/// What people want kept clear of volumes.
struct ClearWish {
  std::set<std::string> kinds;  ///< of `kClearGrounds`
  bool takes_all_streets = false;
  double least_green = 0;  ///< of areas of green: less ground than this is built over [m²]
};

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
  /// or another than before; sites that it does not meet any more leave nothing out for it.
  void keep(std::size_t building, const importing::ContextBuilding& made, const std::string& node, bool is_changed,
            importing::ImportReport& report);
  /// A building that is cleared was a node of the scene, and is none any more: no site leaves its ground out.
  void remove(std::size_t building, const std::string& node);
  /// A building that is cleared is a node that people have changed, and stays.
  void spare(std::size_t building, const std::string& node);
  static constexpr const char* kClearedReason = "it stands inside the site, which is cleared";

  /// Makes sites leave out the streets, rails and areas that are wished and reach into them, up to their whole height, and brings
  /// up to date what an import left out before.
  void clear_grounds(const importing::Context& context, const ClearWish& wish, const GroundSource& from);
  /// The site that leaves out an area or a track of the file, by its row and id; empty: none.
  std::string site_without(std::size_t row, const std::string& id) const;

  /// Did an import leave out ground of one of these sources before?
  bool is_again() const { return is_again_; }
  /// Was any building left out?
  bool has_cleared() const;
  /// The new values of the sites' exclusions, by node.
  std::vector<std::pair<std::string, Table>> exclusions() const;
  /// Notices about the buildings, after all files.
  std::vector<std::string> notes() const;
  /// What people have asked for and did not get, after all files.
  std::vector<std::string> warnings() const;

 private:
  struct Judged : Site {
    std::map<std::string, std::size_t> grounds_left_out, grounds_given_back;  // by kind
    std::map<std::string, std::size_t> brought;           // grounds of the files, by name: how many exclusions each became
    std::set<std::string> small;                          // areas of green in it that are too small, by name
    std::set<std::size_t> kept, reaching, spared_wholes;  // whole buildings that stay, by their number in `judged_`
    std::size_t cleared = 0;
    std::vector<std::string> left, removed, spared;  // nodes that stand here no more; of those that are cleared
  };
  /// A street or an area of a file; its name without its source.
  struct Ground {
    std::string kind, name, use;
    std::size_t row = importing::kNoRow;
    std::string id;         // in the file
    bool is_small = false;  // too small to be kept clear
    std::function<std::vector<geometry::Ring>()> rings;
  };
  /// Of one kind of ground that people want kept clear.
  struct Asked {
    std::size_t found = 0;  // in the files
    bool is_used = false;   // some site leaves such ground out
  };
  struct Stay {
    std::size_t site = 0;
    double share = 0;       // [ratio] of the footprint that lies inside
    std::size_t whole = 0;  // the number of its whole building
    bool is_own = false;    // the site is its place
    bool is_cleared = false;
  };

  double inside(const Site& site, const importing::ContextBuilding& building) const;
  static std::vector<Ground> grounds_of(const importing::Context& context, const ClearWish& wish);
  std::vector<Exclusion> left_out(const Site& site, const Ground& ground);
  void clear_site(Judged& site, const std::vector<Ground>& grounds, const ClearWish& wish, const GroundSource& from);
  void put(Judged& site, const Ground& ground, std::vector<Exclusion> exclusions, const GroundSource& from);
  static std::string grounds_text(const std::map<std::string, std::size_t>& grounds);
  void note_cleared(const Judged& site, std::vector<std::string>& notes) const;
  void note_grounds(const Judged& site, std::vector<std::string>& notes) const;
  bool clears(std::size_t buildings, const std::string& site);

  std::vector<Judged> sites_;
  std::size_t judged_ = 0;  // whole buildings of all files
  InsideChoice choice_;
  bool is_assumed_ = false, is_again_ = false;
  AskToClear ask_;
  std::map<std::size_t, std::vector<Stay>> stays_;  // by building of the file
  std::map<std::pair<std::size_t, std::string>, std::string>
      left_out_;                        // grounds of the file by row and id: the site without them
  std::map<std::string, Asked> asked_;  // by kind
  double least_green_ = 0;              // [m²]
  std::set<std::string> sources_;       // of all files
  std::vector<std::string> ground_notes_;
};

}  // namespace bl::making
