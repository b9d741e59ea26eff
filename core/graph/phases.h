// The phases of a tick as functions from the frozen state to the next one.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/define/definition.h"
#include "core/graph/state.h"

namespace bl {

/// Phase 3: every link reads `frozen` and fills its own slot. Parallel over links.
void evaluate_links(const State& frozen, State& next, ThreadPool& pool);
/// Phase 4: per port, proposals combine in ascending link id; then step limit, hard range, locks last.
void resolve_proposals(const State& frozen, State& next, ThreadPool& pool);
/// Phase 5: typifications without sets, where an input changed. Parallel over nodes.
void evaluate_nodes(const State& frozen, State& next, ThreadPool& pool);
/// Evaluates typifications without sets and without memory whose settings no tick has evaluated yet; returns whether there were
/// any. It is for display only: in a tick, phase 5 does it.
bool evaluate_unasked(State& state, ThreadPool& pool);
/// Caches of typifications with sets, kept from tick to tick by node and type id; no state.
using SetMemos = std::map<std::pair<std::string, std::string>, Memo>;
/// Phase 6: typifications with sets; all read what phase 5 left, then all replies are written, in ascending node id. Analyses
/// are begun here, and their results taken in when they are due.
void evaluate_sets(State& next, ThreadPool& pool, SetMemos& memos, AnalysisRunner& runner);
/// Makes the meshes that were not saved with a state, from the values that were.
void recall_meshes(State& state, ThreadPool& pool, SetMemos& memos);
/// Phase 7: residuals, calm count and hash.
void commit(State& next);

// What the phases share.

/// The multiple of the move limit that a proposal must exceed to start a resting scene again.
inline constexpr double kWakingPush = 2;

/// Are its own outputs among its inputs, as in a filter or a clock? It must then be evaluated exactly once in every tick.
bool keeps_memory(const TypificationDefinition& definition);
/// The place of errors of a typification of a node: "nodes/tower/smart_volume".
std::string place_of(const State& state, std::size_t n, std::size_t t);
/// Stores the results of an evaluation, or keeps the last good values and the error.
void accept_values(const TypificationDefinition& definition, TypeState& state, std::vector<Value>&& values, Result<void> done,
                   const std::string& place);

}  // namespace bl
