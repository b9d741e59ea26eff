// Who may do something in a session with several people, and on what grounds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bl {

enum class Role : std::uint8_t { facilitator, designer, stakeholder, participant, viewer, recorder, device };
inline constexpr std::size_t kRoleCount = 7;
inline constexpr std::array<std::string_view, kRoleCount> kRoleNames = {"facilitator", "designer", "stakeholder", "participant",
                                                                        "viewer",      "recorder", "device"};

/// On what grounds somebody may do something; one that holds is enough.
enum class Ground : std::uint16_t {
  always = 1,         ///< without a condition
  in_area = 2,        ///< what it changes lies in an area of this person, and nobody else has the pen of that area
  own = 4,            ///< what it changes was made by this person, or is the person's own row of a table
  own_in_area = 8,    ///< both
  on_card = 16,       ///< it is a control on the role card of this person, and the value is in its range
  in_draft = 32,      ///< as a step of a draft, which changes nothing of the scene until it is accepted
  own_in_draft = 64,  ///< likewise, of what this person has made
  open_form = 128,    ///< it adds a node of a kind that the phase lets visitors add
  if_allowed = 256,   ///< where whoever opened the room has allowed scripts
  own_in_view = 512,  ///< it changes the layout of what lies in an area of this person
};
using Grounds = std::uint16_t;
constexpr Grounds operator|(Ground a, Ground b) {
  return static_cast<Grounds>(static_cast<Grounds>(a) | static_cast<Grounds>(b));
}
constexpr Grounds operator|(Grounds a, Ground b) { return static_cast<Grounds>(a | static_cast<Grounds>(b)); }
constexpr bool has_ground(Grounds grounds, Ground ground) { return (grounds & static_cast<Grounds>(ground)) != 0; }

/// What a phase of a session lets people do who do not lead it. `any`: nothing of these, so that every phase lets them.
enum class Activity : std::uint8_t { any, change, draft, comment, vote };
inline constexpr std::array<std::string_view, 5> kActivityNames = {"any", "change", "draft", "comment", "vote"};

/// One row of the table of rights: what each role may do with one command or event. What is not said is not allowed.
struct Rights {
  /// Grounds of a role, from one of them or several.
  struct Of {
    Grounds grounds = 0;
    constexpr Of() = default;
    constexpr Of(Ground one) : grounds(static_cast<Grounds>(one)) {}  // NOLINT: implicit on purpose
    constexpr Of(Grounds several) : grounds(several) {}               // NOLINT: implicit on purpose
  };
  Of facilitator = Ground::always;
  Of designer = {}, stakeholder = {}, participant = {}, viewer = {}, recorder = {}, device = {};
  Activity activity = Activity::change;  ///< what the phase must let people do for it; in a draft it is `draft`
  bool is_by_parts = false;              ///< the command holds others: what they may do decides

  constexpr Grounds of(Role role) const {
    const std::array<Of, kRoleCount> row = {facilitator, designer, stakeholder, participant, viewer, recorder, device};
    return row[static_cast<std::size_t>(role)].grounds;
  }
};

}  // namespace bl
