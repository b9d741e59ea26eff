// The commands with their arguments. A scene is changed by commands only.
#pragma once

#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene_edit.h"

namespace bl {

using Inverse = Result<std::vector<Command>>;

// Each command is declared and applied in commands/<id>.cpp. `apply` returns the commands that undo it, in the order to apply.

struct AddNode {
  struct In {
    std::string id;
    JsonValue node;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft,
                                  .stakeholder = Ground::in_draft,
                                  .participant = Ground::open_form | Ground::in_draft,
                                  .device = Ground::own};
  static void declare(CommandBuilder<AddNode>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct RemoveNode {
  struct In {
    std::string id;
  };
  static constexpr Rights kRights{.designer = Ground::own_in_area | Ground::in_draft,
                                  .stakeholder = Ground::own_in_draft,
                                  .participant = Ground::own_in_draft,
                                  .device = Ground::own};
  static void declare(CommandBuilder<RemoveNode>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct RenameNode {
  struct In {
    std::string id, name;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::own};
  static void declare(CommandBuilder<RenameNode>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct Typify {
  struct In {
    std::string node, typification;
    JsonValue values;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<Typify>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct Untypify {
  struct In {
    std::string node, typification;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<Untypify>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetPort {
  struct In {
    std::string node;
    PortChoice port;
    JsonValue value = JsonValue::null();
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft,
                                  .stakeholder = Ground::on_card | Ground::in_draft,
                                  .participant = Ground::on_card,
                                  .device = Ground::own};
  static void declare(CommandBuilder<SetPort>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetCell {
  struct In {
    std::string node;
    PortChoice port;
    std::string row, column;
    JsonValue value = JsonValue::null();
  };
  static constexpr Rights kRights{
      .designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::on_card | Ground::own, .participant = Ground::own};
  static void declare(CommandBuilder<SetCell>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct AddRow {
  struct In {
    std::string node;
    PortChoice port;
    JsonValue row;
    std::int64_t at = -1;
  };
  static constexpr Rights kRights{
      .designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::own, .participant = Ground::own};
  static void declare(CommandBuilder<AddRow>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct RemoveRow {
  struct In {
    std::string node;
    PortChoice port;
    std::string row;
  };
  static constexpr Rights kRights{
      .designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::own, .participant = Ground::own};
  static void declare(CommandBuilder<RemoveRow>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct CastVote {
  struct In {
    std::string node, voter;
    JsonValue ballot = JsonValue::null();
  };
  static constexpr Rights kRights{.facilitator = Ground::own,
                                  .designer = Ground::own,
                                  .stakeholder = Ground::own,
                                  .participant = Ground::own,
                                  .activity = Activity::vote};
  static void declare(CommandBuilder<CastVote>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct LockPort {
  struct In {
    std::string node;
    PortChoice port;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft};
  static void declare(CommandBuilder<LockPort>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct UnlockPort {
  struct In {
    std::string node;
    PortChoice port;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft};
  static void declare(CommandBuilder<UnlockPort>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct AddLink {
  struct In {
    std::string id;
    JsonValue link;
    bool is_resting = false;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<AddLink>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct RemoveLink {
  struct In {
    std::string id;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<RemoveLink>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetLinkEnds {
  struct In {
    std::string id;
    Selection from, to;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<SetLinkEnds>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetLinkParameter {
  struct In {
    std::string id, parameter;
    JsonValue value = JsonValue::null();
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft,
                                  .stakeholder = Ground::on_card | Ground::in_draft,
                                  .participant = Ground::on_card};
  static void declare(CommandBuilder<SetLinkParameter>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetLinkStrength {
  struct In {
    std::string id;
    double strength = 1;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft,
                                  .stakeholder = Ground::on_card | Ground::in_draft,
                                  .participant = Ground::on_card};
  static void declare(CommandBuilder<SetLinkStrength>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct EnableLink {
  struct In {
    std::string id;
    bool enabled = true;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<EnableLink>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct MuteLink {
  struct In {
    std::string id;
    bool muted = true;
  };
  static constexpr Rights kRights{.designer = Ground::in_area | Ground::in_draft, .stakeholder = Ground::in_draft};
  static void declare(CommandBuilder<MuteLink>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetSetting {
  struct In {
    std::string setting;
    JsonValue value = JsonValue::null();
  };
  static constexpr Rights kRights{.designer = Ground::in_draft};
  static void declare(CommandBuilder<SetSetting>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetScript {
  struct In {
    std::string id, text;
    bool even_if_broken = false;
  };
  static constexpr Rights kRights{.facilitator = Ground::if_allowed, .designer = Ground::if_allowed};
  static void declare(CommandBuilder<SetScript>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct RemoveScript {
  struct In {
    std::string id;
  };
  static constexpr Rights kRights{.facilitator = Ground::if_allowed, .designer = Ground::if_allowed};
  static void declare(CommandBuilder<RemoveScript>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};
struct SetView {
  struct In {
    JsonValue changes;
    bool whole = false;
  };
  static constexpr Rights kRights{.designer = Ground::own_in_view};
  static void declare(CommandBuilder<SetView>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
  static Command narrow(const Scene& done, const std::set<Touch>& places);
};
struct Batch {
  struct In {
    CommandList commands;
  };
  static constexpr Rights kRights{.is_by_parts = true};
  static void declare(CommandBuilder<Batch>& c);
  static Inverse apply(SceneEdit& edit, const In& in);
};

/// The arguments as a command, such as command<RemoveNode>({.id = "tower"}).
template <class T>
Command command(const typename T::In& in) {
  return CommandBuilder<T>::command(in);
}

/// Applies one command; on an error the scene is unchanged. Returns the commands that undo it, in the order in which to apply
/// them.
Inverse apply(SceneEdit& edit, const Command& command);

}  // namespace bl
