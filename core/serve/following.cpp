// The messages between two laptops, declared.
#include "core/serve/following.h"

namespace bl::serve {

void Follow::declare(wire::MessageBuilder<Follow>& m) {
  m.from_page().id("follow").doc("The laptop is ready for a copy of the session file.");
  m.field(&Follow::is_safe, "safe").doc("Answers wait until this laptop has stored them, too.");
  m.field(&Follow::address, "address")
      .doc("Where pages find the room once this laptop has it, such as `http://192.168.1.7:8080`.");
}
void CopyPart::declare(wire::MessageBuilder<CopyPart>& m) {
  m.id("copy").doc("A part of the packed session file.");
  m.field(&CopyPart::n, "n").required().doc("The last change that is in it.");
  m.field(&CopyPart::part, "part").required().doc("Bytes in base 64.");
  m.field(&CopyPart::size, "size").doc("Of the file, in the last part.");
  m.field(&CopyPart::digest, "digest").doc("Of the file, in the last part.");
  m.field(&CopyPart::is_last, "last").doc("The file is whole now.");
}
void Changes::declare(wire::MessageBuilder<Changes>& m) {
  m.id("changes").doc("What was stored since the change before.");
  m.field(&Changes::n, "n").required().doc("Its number.");
  m.field(&Changes::bytes, "bytes").required().doc("In base 64.");
}
void Kept::declare(wire::MessageBuilder<Kept>& m) {
  m.from_page().id("kept").doc("All changes up to this one are stored here, too.");
  m.field(&Kept::n, "n").required().doc("Its number.");
}

}  // namespace bl::serve
