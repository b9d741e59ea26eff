// A façade style: glazing, modules, bands and prices by use and orientation, and their application to volumes.
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/facade/dressing_table.h"
#include "core/facade/style_claims.h"
#include "core/facade/style_rows.h"
#include "core/facade/survey_cache.h"

namespace bl {
namespace {

struct FacadeStyle {
  struct In {
    std::string name = "standard";
    Table rows;
    double true_north = 0;
    Selection volumes{{}, "facade", {}}, styles{{}, "facade_style", {}}, surroundings{{}, "smart_volume", {}};
    Selection facades{{}, "facade", {}};
  };
  struct Member {
    std::string id, use;
    std::vector<std::string> style;
    double glazing = 1, ground = 0, storey_height = 0, bottom = 0, spherical_area = 0;
    MeshPointer mesh;
    Shared<Table> neighbours;
  };
  struct Named {
    std::string id, name;
  };
  struct Neighbour {
    std::string id;
    MeshPointer mesh;
  };
  struct Claimant {
    std::string id;
    std::vector<std::string> style;
    double bottom = 0;  // read to see that it exists: the façade belongs to a SmartVolume
  };
  struct Sets {
    std::vector<Member> members;
    std::vector<Named> styles;
    std::vector<Neighbour> surroundings;
    std::vector<Claimant> claimants;
  };
  struct Reply {
    std::optional<std::string> style_in_force, message;
    std::optional<double> facade_area, glazed_area, opaque_area, roof_area, shared_area, glazing_ratio, cost, panels, true_north;
    std::optional<Shared<Table>> by_orientation, by_storey;
  };
  struct Out {
    std::int64_t count = 0;
    double facade_area = 0, glazed_area = 0, cost = 0;
    std::vector<Reply> replies, cleared;
  };

  static void declare(TypificationBuilder<FacadeStyle>& t) {
    t.id("facade_style").label("Façade style");
    t.doc(
        "Rules for façades: the share of glass, the width of modules, the height of sills and bands, and prices. The style "
        "applies to the façades that name it, and adds up their areas.");
    t.in(&In::name, "name").doc("The name by which façades refer to the style; each style of a scene needs a name of its own.");
    declare_rows(t);
    t.in(&In::true_north, "true_north")
        .unit(Unit::degree)
        .range(-360, 360)
        .of_scene(OfScene::always)
        .doc("Direction of true north, clockwise from the scene's y axis. Orientations are measured from it.");
    t.in(&In::volumes, "volumes").doc("The façades that the style may apply to; it applies to those among them that name it.");
    t.in(&In::styles, "styles").doc("All styles of the scene, to find façades that name none of them.");
    t.in(&In::surroundings, "surroundings").doc("The volumes that may cover façades.");
    t.in(&In::facades, "facades")
        .doc("All façades of the scene: those that name this style and are not among its `volumes` get a message.");
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of façades that the style applies to.");
    t.out(&Out::facade_area, "facade_area").unit(Unit::square_metre).doc("Their area.");
    t.out(&Out::glazed_area, "glazed_area").unit(Unit::square_metre).doc("Their area of glass.");
    t.out(&Out::cost, "cost").unit(Unit::euro).doc("Their cost.");
    declare_sets(t);
  }

  static void declare_rows(TypificationBuilder<FacadeStyle>& t) {
    const auto number = [](const char* id, Unit unit, double by_default, double most, const char* doc) {
      return ColumnDefinition{.id = id, .unit = unit, .default_value = by_default, .minimum = 0, .maximum = most, .doc = doc};
    };
    const facade::FacadeRule rule;
    ColumnDefinition module = number("module", Unit::metre, rule.module, 100, "Width of one window with its pier.");
    module.minimum = 0.1;
    t.in(&In::rows, "rows")
        .column({.id = "use", .is_text = true, .default_value = std::string(), .doc = "Use that the row applies to; empty: any."})
        .column({.id = "orientation",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "Orientation that the row applies to, such as `south_west`; empty: any."})
        .column(number("glazing", Unit::ratio, rule.glazing, 1, "Glazed share of each storey."))
        .column(module)
        .column(number("sill", Unit::metre, rule.sill, 50, "Closed parapet above each floor."))
        .column(number("band", Unit::metre, rule.band, 50, "Closed band under the next floor."))
        .column(number("cost_glazed", Unit::none, rule.cost_glazed, 1e6, "Price of glass in euro per square metre."))
        .column(number("cost_opaque", Unit::none, rule.cost_opaque, 1e6, "Price of wall in euro per square metre."))
        .doc("The rules; the first row that fits a use and an orientation applies. Without rows all façades are alike.");
  }

  static void declare_sets(TypificationBuilder<FacadeStyle>& t) {
    t.set("styles", &Sets::styles).reads(&Named::id, "node.id").reads(&Named::name, "facade_style.name");
    t.set("surroundings", &Sets::surroundings).reads(&Neighbour::id, "node.id").reads(&Neighbour::mesh, "smart_volume.mesh");
    auto claimants = t.set("facades", &Sets::claimants, &Out::cleared);
    claimants.reads(&Claimant::id, "node.id").reads(&Claimant::style, "facade.style");
    claimants.reads(&Claimant::bottom, "smart_volume.bottom");
    bind_replies(claimants);
    auto set = t.set("volumes", &Sets::members, &Out::replies);
    set.reads(&Member::id, "node.id").reads(&Member::use, "smart_volume.use").reads(&Member::style, "facade.style");
    set.reads(&Member::glazing, "facade.glazing").reads(&Member::ground, "facade.ground");
    set.reads(&Member::storey_height, "smart_volume.storey_height").reads(&Member::bottom, "smart_volume.bottom");
    set.reads(&Member::spherical_area, "smart_volume.spherical_area");
    set.reads(&Member::mesh, "smart_volume.mesh").reads(&Member::neighbours, "smart_volume.neighbours");
    bind_replies(set);
  }

  template <class Set>
  static void bind_replies(Set& set) {
    set.writes(&Reply::style_in_force, "facade.style_in_force").writes(&Reply::message, "facade.message");
    set.writes(&Reply::facade_area, "facade.facade_area").writes(&Reply::glazed_area, "facade.glazed_area");
    set.writes(&Reply::opaque_area, "facade.opaque_area").writes(&Reply::roof_area, "facade.roof_area");
    set.writes(&Reply::shared_area, "facade.shared_area").writes(&Reply::glazing_ratio, "facade.glazing_ratio");
    set.writes(&Reply::cost, "facade.cost").writes(&Reply::panels, "facade.panels").writes(&Reply::true_north, "facade.true_north");
    set.writes(&Reply::by_orientation, "facade.by_orientation").writes(&Reply::by_storey, "facade.by_storey");
  }

  static Reply bare(std::string message) {
    return {"", std::move(message), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, Table{}, Table{}};
  }

  static Reply reply_of(const In& in, const Member& member, const facade::FacadeSurvey& survey, const facade::FacadeRules& rules,
                        std::string message) {
    const facade::Dressing dressing = dress(survey, rules, member.glazing, member.storey_height);
    const facade::DressedArea& all = dressing.all;
    add_missing_text(dressing, message);
    const double share = all.area() > 0 ? all.glazed / all.area() : 0;
    Table sides, storeys;
    write_sides(dressing, rules, member.glazing, member.storey_height, sides);
    write_storeys(dressing, storeys);
    return {in.name, std::move(message), all.area(), all.glazed, all.opaque, survey.roof, survey.shared, share, all.cost,
            all.panels, in.true_north, std::move(sides), std::move(storeys)};
  }

  static facade::SurveyOptions options_of(const In& in, const Member& member, const facade::FacadeRules& rules) {
    return {member.bottom, member.storey_height, member.ground, in.true_north, member.spherical_area, bands_of(rules, member.storey_height)};
  }

  // Two styles with one name would apply to the same façades.
  static Result<void> check_names(const In& in, const std::vector<Named>& styles) {
    std::vector<std::string> same;
    for (const Named& style : styles)
      if (style.name == in.name) same.push_back(style.id);
    if (same.size() < 2) return {};
    return Error{ErrorCode::duplicate, "name",
                 "`" + same[0] + "` and `" + same[1] + "` are both called `" + in.name + "`: give one of them another name"};
  }

  // Façades without a style must not keep what an earlier style wrote. The style that a façade names clears it where it is not
  // among the style's volumes; where a façade names none, the first style clears it.
  static void clear(const In& in, const Sets& sets, std::span<const std::string> names, Out& out) {
    std::set<std::string> own;
    for (const Member& member : sets.members) own.insert(member.id);
    out.cleared.resize(sets.claimants.size());
    for (std::size_t c = 0; c < sets.claimants.size(); ++c) {
      auto [dresser, message] = facade::settle_claims(sets.claimants[c].style, names);
      if (dresser.empty() && !names.empty() && names.front() == in.name) out.cleared[c] = bare(std::move(message));
      if (dresser != in.name || own.contains(sets.claimants[c].id)) continue;
      message += (message.empty() ? "`" : "; `") + in.name + "` is not allowed to dress it: add it to the `volumes` of that style";
      out.cleared[c] = bare(std::move(message));
    }
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    if (in.name.empty()) return Error{ErrorCode::missing, "name", "the style needs a name, by which façades ask for it"};
    if (auto sound = facade::check_style_rows(in.rows); !sound) return sound.error();
    if (auto single = check_names(in, sets.styles); !single) return single.error();
    std::map<std::string, MeshPointer> shapes;
    for (const Neighbour& volume : sets.surroundings) shapes[volume.id] = volume.mesh;
    std::vector<std::string> names;
    for (const Named& style : sets.styles) names.push_back(style.name);
    Out out;
    clear(in, sets, names, out);
    out.replies.resize(sets.members.size());
    std::vector<facade::SurveyCase> cases;
    std::vector<std::size_t> dressed;
    std::vector<facade::FacadeRules> rules(sets.members.size());
    std::vector<std::string> messages(sets.members.size());
    for (std::size_t m = 0; m < sets.members.size(); ++m) {
      const Member& member = sets.members[m];
      auto [dresser, message] = facade::settle_claims(member.style, names);
      if (dresser != in.name) continue;
      messages[m] = std::move(message);
      rules[m] = facade::rules_of(in.rows, member.use, messages[m]);
      if (!member.mesh) {
        out.replies[m] = bare("it has no shape, so that there is no façade to measure");
        continue;
      }
      facade::SurveyCase& one =
          cases.emplace_back(facade::SurveyCase{member.id, member.mesh, {}, options_of(in, member, rules[m])});
      for (std::size_t row = 0; row < member.neighbours->rows.size(); ++row)
        if (const auto other = shapes.find(member.neighbours->text(row, "node")); other != shapes.end() && other->second)
          one.neighbours.push_back(other->second);
      dressed.push_back(m);
    }
    facade::SurveyCache own;
    facade::SurveyCache& cache = tick.memo != nullptr ? tick.memo->of<facade::SurveyCache>() : own;
    const std::vector<const facade::FacadeSurvey*> surveys = cache.of(cases, tick.pool);
    for (std::size_t k = 0; k < dressed.size(); ++k) {
      const std::size_t m = dressed[k];
      Reply& reply = out.replies[m] = reply_of(in, sets.members[m], *surveys[k], rules[m], std::move(messages[m]));
      ++out.count;
      out.facade_area += *reply.facade_area;
      out.glazed_area += *reply.glazed_area;
      out.cost += *reply.cost;
    }
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(facade_style, FacadeStyle)
