// The parts of the page: people, phases, decisions, proposals, comments, scenarios and refusals.
#include "core/base/text.h"
#include "core/minutes/page.h"

namespace bl::minutes {

namespace {

using Rows = std::vector<std::vector<std::string>>;

// How often an operation was refused for each reason, as people read it. The list is closed (room::Reason).
std::string sentence_of(room::Reason reason) {
  using room::Reason;
  switch (reason) {
    case Reason::bad: return "It did not have the form that it should have.";
    case Reason::gone: return "What it was about was not there any more.";
    case Reason::right: return "The role of the person did not allow it.";
    case Reason::area: return "It was outside the person's own area, or somebody else had the pen of that area.";
    case Reason::phase: return "The phase of the session did not allow it.";
    case Reason::range: return "The value was beyond the range of the role card, or beyond what it can be at all.";
    case Reason::budget: return "There was not that much left to give.";
    case Reason::stale: return "Somebody else had changed the same thing since.";
    case Reason::conflict: return "The scene did not allow it.";
    case Reason::locked: return "The value was locked, or the person was muted.";
    case Reason::closed: return "The vote or the room was closed.";
    case Reason::rate: return "There were too many in a short time.";
    case Reason::size: return "It was too large, or there were too many of them.";
    case Reason::storage: return "The session could not be stored at that moment.";
    case Reason::draining: return "The room was being closed or moved.";
    case Reason::gap: return "What was said before it had not arrived.";
  }
  return {};
}

std::string activities_of(const room::Phase& phase) {
  std::string text;
  for (const Activity activity : phase.activities)
    text += (text.empty() ? "" : ", ") + std::string(kActivityNames[static_cast<std::size_t>(activity)]);
  return text.empty() ? "watch only" : text;
}

std::string subject_of(const Account& account, const room::Comment& comment) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!comment.anchor.node.empty()) add("node " + comment.anchor.node);
  if (!comment.anchor.scenario.empty()) add("scenario " + comment.anchor.scenario);
  if (const auto& place = comment.anchor.place)
    add("place " + fixed(place->x, 1) + ", " + fixed(place->y, 1) + ", " + fixed(place->z, 1) + " m");
  if (comment.anchor.tick) add("tick " + std::to_string(*comment.anchor.tick));
  if (!comment.parent.empty())
    for (std::size_t k = 0; k < account.comments.size(); ++k)
      if (account.comments[k].id == comment.parent) add("comment " + std::to_string(k + 1));
  return text.empty() ? "the whole" : text;
}

Rows comment_rows(const Account& account, bool is_open) {
  Rows rows;
  for (std::size_t k = 0; k < account.comments.size(); ++k) {
    const Commented& one = account.comments[k];
    const room::Comment& comment = account.state.comments.at(one.id);
    if ((comment.state == room::CommentState::open) != is_open) continue;
    std::string answer = account.words(comment.answer);
    if (one.answered_by != 0) answer += (answer.empty() ? "" : " \xE2\x80\x93 ") + account.who(one.answered_by);
    rows.push_back({std::to_string(k + 1), account.words(comment.text), account.who(comment.seat), subject_of(account, comment),
                    std::to_string(ratings_of(comment, 1)), std::to_string(ratings_of(comment, -1)),
                    std::string(room::kCommentStateNames[static_cast<std::size_t>(comment.state)]), answer,
                    account.when(one.moment)});
  }
  return rows;
}

}  // namespace

void write_people(drawing::Markup& page, const Account& account) {
  page.element("h2", "Who took part");
  Rows rows;
  for (const auto& [number, seat] : account.state.seats) {
    const auto joined = account.joined.find(number);
    rows.push_back({std::to_string(number), seat.name, std::string(kRoleNames[static_cast<std::size_t>(seat.role)]),
                    joined == account.joined.end() ? "" : account.when(joined->second), seat.is_removed ? "was removed" : ""});
  }
  write_table(page, {"#Seat", "Pseudonym", "Role", "Joined", "Note"}, rows, "Nobody took part.");
}

void write_phases(drawing::Markup& page, const Account& account) {
  page.element("h2", "Phases");
  Rows rows;
  for (const PhaseSpan& span : account.phases)
    rows.push_back({span.phase.name.empty() ? "without a name" : account.title_words(span.phase.name), account.when(span.begin),
                    span.end ? account.when(*span.end) : "the end of the session", activities_of(span.phase)});
  write_table(page, {"Phase", "From", "To", "What people could do"}, rows, "The session was not divided into phases.");
}

void write_decisions(drawing::Markup& page, const Account& account) {
  page.element("h2", "Decisions and other marks");
  Rows rows;
  for (std::size_t k = 0; k < account.state.marks.size(); ++k) {
    const room::Mark& mark = account.state.marks[k];
    rows.push_back(
        {std::to_string(k + 1), mark.kind, account.words(mark.text), account.who(mark.seat), account.when(account.marks[k])});
  }
  write_table(page, {"#Number", "Kind", "Text", "Marked by", "When"}, rows, "Nothing was marked for the minutes.");
}

void write_proposals(drawing::Markup& page, const Account& account) {
  page.element("h2", "Proposals");
  Rows rows;
  for (const Proposed& one : account.proposals) {
    const room::Proposal& proposal = one.proposal;
    const std::string steps = std::to_string(proposal.steps);
    rows.push_back({proposal.title.empty() ? one.draft : account.title_words(proposal.title), account.words(proposal.why),
                    account.who(proposal.seat), account.when(one.moment),
                    std::string(room::kProposalStateNames[static_cast<std::size_t>(proposal.state)]),
                    one.decided ? account.who(proposal.by) : "", account.words(proposal.answer),
                    one.decided ? account.when(*one.decided) : "",
                    one.decided ? std::to_string(proposal.kept) + " of " + steps : steps + " proposed"});
  }
  write_table(page,
              {"Title", "What it is good for", "Proposed by", "When", "State", "Decided by", "Why", "Decided", "#Steps kept"},
              rows, "Nothing was proposed.");
}

void write_comments(drawing::Markup& page, const Account& account) {
  const std::vector<std::string> columns = {"#Number",   "Comment", "By",     "About", "#Agree",
                                            "#Disagree", "State",   "Answer", "When"};
  page.element("h2", "Open comments");
  write_table(page, columns, comment_rows(account, true), "No comment is open.");
  page.element("h2", "Comments that were decided on");
  write_table(page, columns, comment_rows(account, false), "No comment was decided on.");
}

namespace {

std::string figures_in_words(const Saved& saved) {
  std::string text;
  for (const SavedFigure& figure : saved.figures)
    text += (text.empty() ? "" : "; ") + figure.name + " " + shortest(figure.value) +
            (figure.unit.empty() ? "" : " " + figure.unit) + " (" + figure.status + ")";
  return text;
}

}  // namespace

void write_scenarios(drawing::Markup& page, const Account& account) {
  page.element("h2", "Scenarios");
  Rows rows;
  for (const Saved& saved : account.scenarios) {
    const room::Scenario& scenario = account.state.scenarios.at(saved.id);
    rows.push_back({scenario.name.empty() ? saved.id : account.title_words(scenario.name), account.words(scenario.note),
                    account.who(scenario.seat), std::to_string(scenario.seq), account.when(saved.moment), figures_in_words(saved),
                    saved.file()});
  }
  write_table(page, {"Scenario", "Note", "Saved by", "#Entry", "When", "Figures", "File"}, rows, "No scenario was saved.");
  page.element("p", "The scene as it was after the last entry is in scenes/end.json.");
}

void write_refusals(drawing::Markup& page, const Account& account) {
  page.element("h2", "What was refused");
  Rows rows;
  for (const auto& [reason, count] : account.refusals)
    rows.push_back({std::to_string(count), std::string(room::name_of(reason)), sentence_of(reason)});
  write_table(page, {"#Times", "Reason", "Meaning"}, rows, "Nothing was refused.");
}

}  // namespace bl::minutes
