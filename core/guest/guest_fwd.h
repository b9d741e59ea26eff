// Names a guest of a room, for headers that need not know more of it.
#pragma once

namespace bl::guest {

class RoomGuest;

}  // namespace bl::guest
