// A sun study: measures the sun of receivers among casters, and writes to both how much each caster takes.
#include <map>
#include <optional>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/cell_mesh.h"
#include "core/sun/moment_table.h"
#include "core/sun/shadow_shape.h"
#include "core/sun/study_cache.h"

namespace bl {
namespace {

struct SunStudyNode {
  struct In {
    Selection sun{{}, "sun_and_sky", {}}, volumes{{}, "shadow_caster", {}}, buildings{{}, "shadow_caster", {}};
    Selection receivers{{}, "shadow_receiver", {}};
    double ground = 0;
    int latency = 3;
  };
  struct Sun {
    std::string id;
    Vector3 direction;
    Shared<Table> moments;
  };
  struct Caster {
    std::string id;
    bool casts = true;
    MeshPointer mesh;
  };
  struct Receiver {
    std::string id;
    Point3 position;
    bool upright = false;
    double azimuth = 0, width = 0, depth = 0, rotation = 0, raised = 0, spacing = 0, required = 0, share = 1;
    std::vector<std::string> casters;
  };
  struct Sets {
    std::vector<Sun> suns;
    std::vector<Caster> volumes, buildings;
    std::vector<Receiver> receivers;
  };
  // Nothing for a node that gets its reply as a member of the other set.
  struct CasterReply {
    std::optional<double> lost, shared;
    std::optional<std::string> worst;
    std::optional<Table> taken;
    std::optional<std::vector<Point3>> outline;
  };
  struct ReceiverReply {
    Vector3 half_across, half_up;
    double area = 0, least = 0, mean = 0, most = 0, possible = 0, share_met = 0, of_share = 0, deficit = 0;
    Table losses, map;
    std::int64_t columns = 0, rows = 0;
  };
  struct Out {
    std::int64_t caster_count = 0, receiver_count = 0, moment_count = 0, ray_count = 0;
    double area = 0, sun_mean = 0, sun_possible = 0, share_met = 0;
    std::string message;
    std::vector<CasterReply> volumes, buildings;
    std::vector<ReceiverReply> receivers;
  };

  static void declare(TypificationBuilder<SunStudyNode>& t) {
    t.id("sun_study").label("Sun study");
    t.doc(
        "Follows rays from the points of all receivers to the sun, at the moments of the sun's period. It writes to each "
        "receiver the sun that it gets and the casters that take it, and to each caster the sun that it takes. Receivers for "
        "which nothing has changed keep their figures. Studies of more than 200 million rays are refused. SmartVolumes cast the "
        "shadow of a mesh whose faces are split in four once, whatever the tessellation of their solver.");
    t.in(&In::sun, "sun").doc("The sun whose period is studied. The selection must give exactly one node.");
    t.in(&In::volumes, "volumes")
        .doc("The SmartVolumes that cast shadow; nodes without the role of a shadow caster do not count.");
    t.in(&In::buildings, "buildings")
        .doc("The existing buildings that cast shadow; they need the role of a shadow caster as well.");
    t.in(&In::receivers, "receivers").doc("The receivers that are measured; a receiver belongs to one study only.");
    t.in(&In::ground, "ground")
        .unit(Unit::metre)
        .range(-1e5, 1e5)
        .soft(-10, 50)
        .doc("Height of the plane for the outlines of shadows.");
    t.latency(&In::latency, "latency")
        .doc("Number of ticks until a result counts; ticks go on meanwhile. Set more for large studies, 0 to wait for each.");
    t.out(&Out::caster_count, "caster_count").unit(Unit::count).doc("Number of casters that have a shape and are switched on.");
    t.out(&Out::receiver_count, "receiver_count").unit(Unit::count).doc("Number of receivers.");
    t.out(&Out::moment_count, "moment_count").unit(Unit::count).doc("Number of moments that are evaluated.");
    t.out(&Out::ray_count, "ray_count").unit(Unit::count).doc("Number of pairs of points and moments.");
    t.out(&Out::area, "area").unit(Unit::square_metre).doc("Area of all receivers.");
    t.out(&Out::sun_mean, "sun_mean").unit(Unit::second).doc("Direct sun per day, as the mean over that area.");
    t.out(&Out::sun_possible, "sun_possible").unit(Unit::second).doc("Mean direct sun per day without any caster.");
    t.out(&Out::share_met, "share_met").unit(Unit::ratio).soft(0, 1).doc("Share of that area that gets its required sun.");
    t.out(&Out::message, "message")
        .doc("The largest loss and its caster, names that belong to no caster, and whether any sun counts; else empty.");
    t.set("sun", &Sets::suns)
        .reads(&Sun::id, "node.id")
        .reads(&Sun::direction, "sun_and_sky.direction")
        .reads(&Sun::moments, "sun_and_sky.moments");
    bind_casters(t.set("volumes", &Sets::volumes, &Out::volumes), "smart_volume.mesh");
    bind_casters(t.set("buildings", &Sets::buildings, &Out::buildings), "existing_building.mesh");
    declare_receivers(t);
  }

  template <class Set>
  static void bind_casters(Set set, const char* mesh) {
    set.reads(&Caster::id, "node.id").reads(&Caster::casts, "shadow_caster.casts").reads(&Caster::mesh, mesh);
    set.writes(&CasterReply::lost, "shadow_caster.sun_lost").writes(&CasterReply::shared, "shadow_caster.sun_shared");
    set.writes(&CasterReply::worst, "shadow_caster.worst").writes(&CasterReply::taken, "shadow_caster.taken");
    set.writes(&CasterReply::outline, "shadow_caster.outline");
  }

  static void declare_receivers(TypificationBuilder<SunStudyNode>& t) {
    auto set = t.set("receivers", &Sets::receivers, &Out::receivers);
    set.reads(&Receiver::id, "node.id").reads(&Receiver::position, "node.position", Unit::metre);
    set.reads(&Receiver::upright, "shadow_receiver.upright").reads(&Receiver::azimuth, "shadow_receiver.azimuth");
    set.reads(&Receiver::width, "shadow_receiver.width").reads(&Receiver::depth, "shadow_receiver.depth");
    set.reads(&Receiver::rotation, "shadow_receiver.rotation").reads(&Receiver::raised, "shadow_receiver.raised");
    set.reads(&Receiver::spacing, "shadow_receiver.spacing").reads(&Receiver::required, "shadow_receiver.required_sun");
    set.reads(&Receiver::share, "shadow_receiver.required_share").reads(&Receiver::casters, "shadow_receiver.casters");
    set.writes(&ReceiverReply::half_across, "shadow_receiver.half_across")
        .writes(&ReceiverReply::half_up, "shadow_receiver.half_up");
    set.writes(&ReceiverReply::area, "shadow_receiver.area").writes(&ReceiverReply::possible, "shadow_receiver.sun_possible");
    set.writes(&ReceiverReply::least, "shadow_receiver.sun_min").writes(&ReceiverReply::mean, "shadow_receiver.sun_mean");
    set.writes(&ReceiverReply::most, "shadow_receiver.sun_max").writes(&ReceiverReply::share_met, "shadow_receiver.share_met");
    set.writes(&ReceiverReply::of_share, "shadow_receiver.sun_of_share");
    set.writes(&ReceiverReply::deficit, "shadow_receiver.deficit").writes(&ReceiverReply::losses, "shadow_receiver.losses");
    set.writes(&ReceiverReply::columns, "shadow_receiver.columns").writes(&ReceiverReply::rows, "shadow_receiver.rows");
    set.writes(&ReceiverReply::map, "shadow_receiver.map");
  }

  static Result<std::vector<sun::SunMoment>> moments_of(const std::vector<Sun>& suns) {
    if (suns.empty())
      return Error{ErrorCode::missing, "sun", "a sun is needed and none was found: add a node `sun_and_sky`, or choose one here"};
    if (suns.size() > 1)
      return Error{ErrorCode::conflict, "sun",
                   "`" + suns[0].id + "` and `" + suns[1].id + "` are both suns: choose the one that is studied here"};
    return sun::moments_in(*suns.front().moments);
  }

  // All casters, each node once. A node that is both a SmartVolume and an existing building casts with both shapes.
  struct Casters {
    std::vector<sun::SunCaster> list;  // the volumes in their order, then the buildings that are not volumes
    std::vector<std::size_t> of_buildings;
    std::map<std::string, std::size_t> index;

    explicit Casters(const Sets& sets) {
      for (const Caster& caster : sets.volumes) add(caster);
      for (const Caster& caster : sets.buildings) of_buildings.push_back(add(caster));
    }
    std::size_t add(const Caster& caster) {
      const bool has_shape = caster.casts && caster.mesh && !caster.mesh->triangles.empty();
      const auto [it, is_new] = index.emplace(caster.id, list.size());
      if (is_new) list.push_back({caster.id, nullptr});
      MeshPointer& mesh = list[it->second].mesh;
      if (has_shape) mesh = mesh ? both(*mesh, *geometry::study_mesh(caster.mesh)) : geometry::study_mesh(caster.mesh);
      return it->second;
    }
    static MeshPointer both(const Mesh& one, const Mesh& other) {
      auto mesh = std::make_shared<Mesh>();
      mesh->vertices = one.vertices;
      mesh->triangles = one.triangles;
      const auto first = static_cast<std::uint32_t>(one.vertices.size());
      mesh->vertices.insert(mesh->vertices.end(), other.vertices.begin(), other.vertices.end());
      for (const auto& [a, b, c] : other.triangles) mesh->triangles.push_back({first + a, first + b, first + c});
      return mesh;
    }
  };

  static sun::SunReceiver receiver_of(const Receiver& from, const Casters& casters, std::string& message) {
    sun::SunReceiver receiver;
    receiver.centre = from.position + Vector3{0, 0, from.raised};
    receiver.spacing = from.spacing;
    receiver.required = from.required;
    receiver.required_share = from.share;
    if (from.upright) upright_axes(from.width, from.depth, from.azimuth, receiver);
    else level_axes(from.width, from.depth, from.rotation, receiver);
    if (from.casters.empty()) return receiver;
    receiver.mask.resize(casters.list.size(), 0);
    for (const std::string& name : from.casters) {
      const auto it = casters.index.find(name);
      if (it != casters.index.end()) receiver.mask[it->second] = 1;
      else message += "`" + from.id + "` names the caster `" + name + "`, which this study does not know; ";
    }
    return receiver;
  }

  static ReceiverReply reply_of(const sun::SunReceiver& receiver, const sun::SunRecord& record,
                                const std::vector<sun::SunCaster>& casters) {
    ReceiverReply reply{receiver.half_across,
                        receiver.half_up,
                        4 * norm(receiver.half_across) * norm(receiver.half_up),
                        record.least,
                        record.mean,
                        record.most,
                        record.hours.possible,
                        record.share_met,
                        record.of_share,
                        record.deficit,
                        {{"node", "lost", "shared"}, {}},
                        {{"x", "y", "z", "sun"}, {}},
                        static_cast<std::int64_t>(record.grid.columns),
                        static_cast<std::int64_t>(record.grid.rows)};
    for (std::size_t k = 0; k < casters.size(); ++k)
      if (const sun::SunLoss& loss = record.hours.casters[k]; loss.shared > 0)
        reply.losses.rows.push_back({casters[k].name, loss.lost, loss.shared});
    for (std::size_t i = 0; i < record.grid.points.size(); ++i) {
      const Point3& place = record.grid.points[i].place;
      reply.map.rows.push_back({place.x, place.y, place.z, record.hours.seconds[i]});
    }
    return reply;
  }

  // Writes the sun that each caster takes from all receivers; returns the largest single loss as a sentence.
  static std::string deal_out(const std::vector<sun::SunRecord>& records, const std::vector<Receiver>& receivers,
                              const std::vector<sun::SunCaster>& casters, Out& out, std::vector<CasterReply>& replies) {
    std::string sentence;
    double worst = 0;
    for (std::size_t k = 0; k < casters.size(); ++k) {
      CasterReply& reply = replies[k];
      reply.taken->columns = {"receiver", "lost", "shared"};
      double most = 0;
      for (std::size_t r = 0; r < records.size(); ++r) {
        const sun::SunLoss& loss = records[r].hours.casters[k];
        if (!(loss.shared > 0)) continue;
        const double share = out.receivers[r].area / out.area;
        *reply.lost += loss.lost * share;
        *reply.shared += loss.shared * share;
        reply.taken->rows.push_back({receivers[r].id, loss.lost, loss.shared});
        if (loss.shared <= most) continue;
        most = loss.shared;
        reply.worst = receivers[r].id;
      }
      if (most <= worst) continue;
      worst = most;
      sentence =
          "`" + casters[k].name + "` takes most: " + fixed(worst / 60, 0) + " min of sun a day from `" + *reply.worst + "`";
    }
    return sentence;
  }

  // The algorithm names a caster by its index.
  static Error named(Error error, const std::vector<sun::SunCaster>& casters) {
    const auto index = parse_number(error.place);
    if (!index || !(*index < static_cast<double>(casters.size()))) return error;
    error.message = "`" + casters[static_cast<std::size_t>(*index)].name + "`: " + error.message;
    error.place = "volumes";
    return error;
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    const auto moments = moments_of(sets.suns);
    if (!moments) return moments.error();
    Out out;
    if (moments->empty()) out.message = "no sun counts in the period of `" + sets.suns.front().id + "`, which says why; ";
    const Casters casters(sets);
    std::vector<CasterReply> replies;
    for (const sun::SunCaster& caster : casters.list) {
      out.caster_count += caster.mesh ? 1 : 0;
      auto outline =
          caster.mesh ? sun::shadow_outline(*caster.mesh, sets.suns.front().direction, in.ground) : std::vector<Point3>{};
      replies.push_back({0.0, 0.0, "", Table{}, std::move(outline)});
    }
    std::vector<sun::SunCase> cases;
    for (const Receiver& receiver : sets.receivers) cases.push_back({receiver.id, receiver_of(receiver, casters, out.message)});
    sun::SunStudyCache own;
    sun::SunStudyCache& cache = tick.memo != nullptr ? tick.memo->of<sun::SunStudyCache>() : own;
    const auto records = cache.of(casters.list, *moments, cases, tick.pool);
    if (!records) return named(records.error(), casters.list);
    for (std::size_t r = 0; r < cases.size(); ++r) {
      const sun::SunRecord& record = (*records)[r];
      const ReceiverReply& reply = out.receivers.emplace_back(reply_of(cases[r].receiver, record, casters.list));
      out.area += reply.area;
      out.sun_mean += reply.area * record.mean;
      out.sun_possible += reply.area * record.hours.possible;
      out.share_met += reply.area * record.share_met;
      out.ray_count += static_cast<std::int64_t>(record.grid.points.size() * moments->size());
    }
    out.receiver_count = static_cast<std::int64_t>(cases.size());
    out.moment_count = static_cast<std::int64_t>(moments->size());
    if (out.area > 0) {
      for (double* mean : {&out.sun_mean, &out.sun_possible, &out.share_met}) *mean /= out.area;
      out.message += deal_out(*records, sets.receivers, casters.list, out, replies);
    }
    if (out.message.ends_with("; ")) out.message.resize(out.message.size() - 2);
    out.volumes.assign(replies.begin(), replies.begin() + static_cast<std::ptrdiff_t>(sets.volumes.size()));
    for (const std::size_t caster : casters.of_buildings)
      out.buildings.push_back(caster < sets.volumes.size() ? CasterReply{} : std::move(replies[caster]));
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(sun_study, SunStudyNode)
