// Invitations to print: for each person a card with an address and its QR code.
#pragma once

#include <map>
#include <string>

#include "core/base/result.h"

namespace bl::desktop {

/// An HTML page with `people[role]` cards for each role that has a key. `page`: the address of the room.
Result<std::string> invitation_page(const std::string& page, const std::map<std::string, std::string>& keys,
                                    const std::map<std::string, int>& people);
/// The same as a file that only this person can read, because who has a key comes in by it.
Result<void> write_invitations(const std::string& path, const std::string& page, const std::map<std::string, std::string>& keys,
                               const std::map<std::string, int>& people);

}  // namespace bl::desktop
