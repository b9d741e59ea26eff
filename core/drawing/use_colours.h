// The one table of colours by use: what has the same name has the same colour in each drawing, table, file, page and window.
#pragma once

#include <string>

#include "core/drawing/palette.h"

namespace bl::drawing {

struct UseColour {
  Colour colour;
  int cad = 0;  ///< the nearest number in AutoCAD's list of colours, which DXF R2000 knows alone
};

/// What grows on ground of such a use, as far as its name says it: models of cities have kinds of their own for it.
enum class GroundCover { none, plants, water };
GroundCover cover_of_use(const std::string& use);

/// It follows from the name alone, in whatever case and number, never from other uses. Well-known uses have the colours that they
/// have in land-use plans; a name that holds such a word ("student housing") has a tone of that colour; other names have tones of
/// their own, by a hash of the name. Without a name: grey.
UseColour use_colour(const std::string& use);

}  // namespace bl::drawing
