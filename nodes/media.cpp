// A picture in the scene: on the ground, as an upright board, or in the plane of a camera's view.
#include <numbers>

#include "core/base/mathematics.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Media {
  enum class Kind { picture, sequence };
  enum class Placement { ground, billboard, camera };
  enum class Consent { unknown, given, not_needed, refused };

  struct In {
    std::string file;
    Kind kind = Kind::picture;
    double rate = 1;
    std::int64_t frames = 1;
    Placement placement = Placement::billboard;
    double size = 10, azimuth = 0, tilt = 0, field_of_view = 60, distance = 10, opacity = 1;
    Consent consent = Consent::unknown;
    std::string licence, author, note;
    std::int64_t pixel_width = 0, pixel_height = 0, orientation = 1;
    std::string taken;
    double latitude = 0, longitude = 0;
  };

  struct Out {
    double width = 10, height = 10, aspect = 1;
    bool is_free = false;
    std::string message;
  };

  static void declare(TypificationBuilder<Media>& t) {
    t.id("media").label("Media");
    t.doc(
        "A picture or a sequence of pictures at the node's position. The ports got the metadata of the file when it was placed; "
        "a tick reads no files. Pictures without consent are veiled and left out of exports.");
    t.in(&In::file, "file")
        .reaches_out()
        .doc(
            "JPEG or PNG file, relative to the scene file; in a sequence `#` stands for the number of the frame, `###` for 007.");
    t.in(&In::kind, "kind",
         {{Kind::picture, "picture", "One picture."}, {Kind::sequence, "sequence", "Pictures that follow each other."}})
        .doc("One picture or several.");
    t.in(&In::rate, "rate")
        .range(0, 1000)
        .soft(0.1, 30)
        .doc("Frames of a sequence in each second of the scene, where a second counts as thirty ticks.");
    t.in(&In::frames, "frames")
        .unit(Unit::count)
        .range(1, 1e6)
        .soft(1, 500)
        .doc("Number of frames of a sequence, counted from 1. After the last frame it begins again.");
    declare_place(t);
    declare_rights(t);
    declare_facts(t);
  }

  static void declare_place(TypificationBuilder<Media>& t) {
    t.in(&In::placement, "placement",
         {{Placement::ground, "ground", "Flat on the ground, its upper edge towards the azimuth."},
          {Placement::billboard, "billboard", "Upright on the position, facing the azimuth."},
          {Placement::camera, "camera", "In front of a camera at the position, on a plane across its line of sight."}})
        .doc("How the picture is placed in the scene.");
    t.in(&In::size, "size")
        .unit(Unit::metre)
        .range(0.01, 1e5)
        .soft(1, 200)
        .doc("Width on the ground or as a billboard; the height follows.");
    t.in(&In::azimuth, "azimuth")
        .unit(Unit::degree)
        .range(-360, 360)
        .soft(0, 360)
        .doc("Direction that the picture or its camera faces, clockwise from the scene's y axis.");
    t.in(&In::tilt, "tilt")
        .unit(Unit::degree)
        .range(-90, 90)
        .soft(-45, 45)
        .doc("Angle of the camera's line of sight above the horizon.");
    t.in(&In::field_of_view, "field_of_view")
        .unit(Unit::degree)
        .range(1, 170)
        .soft(20, 120)
        .doc("Horizontal field of view of the camera.");
    t.in(&In::distance, "distance")
        .unit(Unit::metre)
        .range(0.01, 1e5)
        .soft(1, 200)
        .doc("Distance from the camera to the plane of the picture.");
    t.in(&In::opacity, "opacity")
        .unit(Unit::ratio)
        .range(0, 1)
        .combine(CombineRule::blend)
        .doc("Opacity: 0 is invisible, 1 covers what is behind.");
  }

  static void declare_rights(TypificationBuilder<Media>& t) {
    t.in(&In::consent, "consent",
         {{Consent::unknown, "unknown", "Nobody has asked: the picture is veiled."},
          {Consent::given, "given", "The people in it, or its owners, agree to its use."},
          {Consent::not_needed, "not_needed", "It shows nobody, and its use is free."},
          {Consent::refused, "refused", "It must not be shown: the picture is veiled."}})
        .doc("Whether the picture may be shown. Without consent the picture is veiled and left out of exports.");
    t.in(&In::licence, "licence").doc("Licence of the picture.");
    t.in(&In::author, "author").doc("Who made it.");
    t.in(&In::note, "note").doc("A remark for people.");
  }

  static void declare_facts(TypificationBuilder<Media>& t) {
    t.in(&In::pixel_width, "pixel_width").unit(Unit::count).range(0, 65535).doc("Width in the file; 0 where it is not known.");
    t.in(&In::pixel_height, "pixel_height").unit(Unit::count).range(0, 65535).doc("Height in the file; 0 where it is not known.");
    t.in(&In::orientation, "orientation").range(1, 8).doc("Orientation of the picture, 1 to 8 as in EXIF.");
    t.in(&In::taken, "taken").doc("When it was taken, by the camera's clock; empty where it is not known.");
    t.in(&In::latitude, "latitude")
        .unit(Unit::degree)
        .range(-90, 90)
        .doc("Where it was taken; 0 beside longitude 0 where it is not known.");
    t.in(&In::longitude, "longitude").unit(Unit::degree).range(-180, 180).doc("Where it was taken.");
    t.out(&Out::width, "width").unit(Unit::metre).doc("Width in the scene.");
    t.out(&Out::height, "height").unit(Unit::metre).doc("Height in the scene.");
    t.out(&Out::aspect, "aspect").unit(Unit::ratio).doc("Width over height as displayed; 1 where it is not known.");
    t.out(&Out::is_free, "is_free").doc("On where the picture may be shown and exported.");
    t.out(&Out::message, "message").doc("Why it is veiled or cannot be placed; empty where there is no problem.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    Out out;
    const bool is_known = in.pixel_width > 0 && in.pixel_height > 0;
    if (is_known) out.aspect = static_cast<double>(in.pixel_width) / static_cast<double>(in.pixel_height);
    if (in.orientation >= 5) out.aspect = 1 / out.aspect;
    const double half = in.field_of_view * std::numbers::pi / 360;
    out.width = in.placement == Placement::camera ? 2 * in.distance * mathematics::tangent(half) : in.size;
    out.height = out.width / out.aspect;
    out.is_free = in.consent == Consent::given || in.consent == Consent::not_needed;
    if (in.file.empty()) out.message = "no file is given: place a picture, or name one";
    else if (in.consent == Consent::refused) out.message = "it must not be shown, so that it is veiled and left out of exports";
    else if (!out.is_free)
      out.message = "nobody has said that it may be shown: set `consent`, until then it is veiled and left out of exports";
    else if (!is_known) out.message = "its size is not known: place the file again, and its pixels are read";
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(media, Media)
