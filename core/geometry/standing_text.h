// Sentences about volumes that stand, with people's names of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/geometry/domain.h"
#include "core/geometry/standing_tick.h"

namespace bl::geometry {

/// An error of a site, which its level counts by itself, with the number of its wish: "site 3 cannot stand: ...". `members`: the
/// wishes of the level.
Error error_of_wish(const Error& error, std::span<const std::uint32_t> members);

/// Why a volume has no footprint; empty where it has one. Lists are in the order of the wishes.
std::string missing_text(const StandingWish& wish, const StandingResult& result, std::span<const std::string> names);

/// Those that have nothing because their positions lie outside of the boundary, each sentence after "; ".
std::string outside_text(std::span<const StandingWish> wishes, std::span<const StandingResult> results, const Domain& domain,
                         std::span<const std::string> names);

/// What is built otherwise than people have set it, each sentence after "; ". `buildings`: the results of whole buildings, where
/// volumes share a footprint; `tolerance`: the share by which a volume may miss what it wants.
std::string other_storeys_text(std::span<const StandingWish> wishes, std::span<const StandingResult> results,
                               std::span<const StandingResult> buildings, const Domain& domain, double tolerance,
                               std::span<const std::string> names);

/// Those that have less floor area than they want, each after "; ": the three that lack most, and how many there are besides.
std::string floor_losses_text(std::span<const FloorLoss> losses, std::span<const std::string> names);

/// The same of a cellar that volume i asks for and cannot have.
std::string lost_cellar_text(const StandingResult& result, std::size_t i, std::span<const std::string> names);

}  // namespace bl::geometry
