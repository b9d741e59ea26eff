// An export format as a declaration: what it is for, its options, and the function that writes its files. One format is one file
// of core/export/formats.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/define/port_builder.h"
#include "core/export/forms.h"
#include "core/export/proposal_model.h"

namespace bl::exporting {

/// One file of a format: its name within a folder, and all of its bytes.
struct ExportFile {
  std::string name, content;
};

struct ExportFiles {
  std::vector<ExportFile> files;   ///< one, or several for a folder
  std::vector<std::string> notes;  ///< sentences on what the format cannot hold or had to change
};

/// By what all files of a format are known: its first bytes, and where files of other programs begin in the same way, words
/// further on as well.
struct FileMark {
  std::string begin;
  std::string within;  ///< words within the first `kMarkReach` bytes
  std::string end;     ///< its last bytes
};
inline constexpr std::size_t kMarkReach = 16384;

struct FormatDefinition : TypeDefinition {
  std::string ending;  ///< of its files, with the point: ".dxf"
  /// Its files have one or the other: an existing file is replaced only where it does, too.
  std::vector<FileMark> marks;
  /// The file of the built page that its files are made of, such as "proposal.html"; empty: none. Who calls it puts its content
  /// into the proposal.
  std::string shell;
  bool may_fill_folder = false;  ///< it makes several files where it is given a folder, and one where it is given a file
  /// From a proposal and the values of all options, in order. `is_folder`: several files are wanted.
  std::function<Result<ExportFiles>(const Proposal&, std::span<const Value> options, bool is_folder)> write;
};

/// T has `struct Options`, `static void declare(FormatBuilder<T>&)`, and `static Result<ExportFiles> write(const Proposal&,
/// const Options&)`, or the same with a `bool is_folder` behind.
template <class T>
class FormatBuilder : public TypeBuilder<FormatDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using Options = typename T::Options;

  FormatBuilder& ending(std::string text) {
    definition_->ending = std::move(text);
    return *this;
  }
  FormatBuilder& begins(std::string text) { return marked({std::move(text), "", ""}); }
  FormatBuilder& marked(FileMark mark) {
    definition_->marks.push_back(std::move(mark));
    return *this;
  }
  /// `write` finds the content of that file as `Proposal::shell`.
  FormatBuilder& shell(std::string file) {
    definition_->shell = std::move(file);
    return *this;
  }
  /// Options may come from a struct that several formats share.
  template <class M, class Shared>
  requires std::derived_from<Options, Shared> PortBuilder<M> option(M Shared::*member, std::string_view id) {
    return add_port(definition_->ports, static_cast<M Options::*>(member), id);
  }
  template <ChoiceMember E, class Shared>
  requires std::derived_from<Options, Shared> PortBuilder<E> option(E Shared::*member, std::string_view id,
                                                                    std::vector<Choice<E>> choices) {
    return add_choice(definition_->ports, static_cast<E Options::*>(member), id, std::span<const Choice<E>>(choices));
  }

  static FormatDefinition build() {
    FormatDefinition definition;
    FormatBuilder builder(definition);
    T::declare(builder);
    const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition.ports);
    constexpr bool kFillsFolder = requires(const Proposal& p, const Options& o) { T::write(p, o, true); };
    definition.may_fill_folder = kFillsFolder;
    definition.write = [ports](const Proposal& proposal, std::span<const Value> values, bool is_folder) -> Result<ExportFiles> {
      Options options;
      set_members(*ports, values, &options);
      (void)is_folder;
      const auto written = [&](const Proposal& formed) -> Result<ExportFiles> {
        if constexpr (kFillsFolder) return T::write(formed, options, is_folder);
        else return T::write(formed, options);
      };
      if constexpr (std::derived_from<Options, FormOptions>) {
        if (options.form != VolumeForm::as_is) {
          if constexpr (requires { T::why_not(options.form); })
            if (const std::string why = T::why_not(options.form); !why.empty())
              return Error{ErrorCode::out_of_range, "form", why};
          const Proposal formed = in_form(proposal, options.form);
          if (formed.buildings.empty())
            return Error{ErrorCode::missing, "form",
                         std::string("no volume has a body ") + reading::choice_of(options.form).measured};
          auto made = written(formed);
          // Volumes that have a body in the scene, and none in this form.
          for (std::size_t k = proposal.shapeless.size(); made && k < formed.shapeless.size(); ++k)
            made->notes.push_back("in tables only: " + formed.shapeless[k].label + ": " + formed.shapeless[k].why_shapeless);
          return made;
        }
      }
      return written(proposal);
    };
    return definition;
  }
};

/// For formats whose options begin with FormOptions: the proposal comes in the form that is asked for. A format that cannot say
/// one has `static std::string why_not(VolumeForm)`, a sentence, empty for those that it can.
template <class T>
void declare_form_option(FormatBuilder<T>& f) {
  f.option(&FormOptions::form, "form", form_choices())
      .doc("In which form volumes are drawn and measured; plots and indicators keep the figures of the scene.");
}

using FormatList = std::vector<FormatDefinition>;
/// All formats of the program, in the order of their ids.
const FormatList& all_formats();
/// Written by the build from the files of core/export/formats.
void register_formats(FormatList& list);
/// nullptr where there is none of that id.
const FormatDefinition* find_format(std::string_view id);
/// Was the file exported in that format? From its first `kMarkReach` bytes, or more, and its last ones.
bool has_mark(const FormatDefinition& format, std::string_view head, std::string_view tail);

}  // namespace bl::exporting

/// Closes a file of core/export/formats: makes its format known under the file's stem.
#define BL_FORMAT(stem, Type) \
  void register_format_##stem(FormatList& list) { list.push_back(FormatBuilder<Type>::build()); }
