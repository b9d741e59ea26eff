// Where a node came from: its file, its element there, and what the file said; a second role of what an import made.
#include <string>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Imported {
  struct In {
    std::string source, element, licence, as_read;
  };
  struct Out {
    std::string message;
  };

  static void declare(TypificationBuilder<Imported>& t) {
    t.id("imported").label("Imported");
    t.doc(
        "Where a node came from, as a second role. By it an import that comes again knows what it brought before, and whether "
        "people have changed it since.");
    t.in(&In::source, "source").doc("The file or the source that the node came from.");
    t.in(&In::element, "element").doc("The id of its element there.");
    t.in(&In::licence, "licence").doc("The licence of the data.");
    t.in(&In::as_read, "as_read")
        .doc(
            "A hash of what the import set. A node that has another one by now was changed by people; an import then leaves it "
            "as it is.");
    t.out(&Out::message, "message").doc("What an import cannot know, as a sentence; empty where it knows the node again.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (in.source.empty() || in.element.empty()) return Out{"no import knows this node again: it has no source or no element"};
    return Out{};
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(imported, Imported)
