#pragma once
#include <optional>

#include "core/own_keys.h"
#include "coupling/own_values.h"
#include "study/build.h"

namespace morula::scenarios {

/// Declares the keys of a thing in its section. `must`: those that are required must be there; else who builds the thing looks for them.
void declare_own_keys(Section& section, const std::vector<OwnKey>& keys, draft::OwnSection& own, bool must);

/// Declares the keys of several things in one section; a key that two of them have stands there once.
void declare_own_keys(Section& section, const std::vector<const std::vector<OwnKey>*>& all, draft::OwnSection& own, bool must);

/// Names of the keys that must be given and are not.
std::vector<std::string> missing_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own);
/// How keys of these names may be written: "for example `field: oxygen`".
std::string example_of(const std::vector<OwnKey>& keys, const std::vector<std::string>& names);
/// Names of the keys that are given.
std::vector<std::string> given_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own);
/// Where a key stands that is given.
Place place_of_key(const draft::OwnSection& own, const std::string& key);
/// The resolved study does not name this key: its default has no meaning here.
void leave_away(draft::OwnSection& own, const std::string& key);
/// Tells that a key that is given has no effect: E515.
void tell_without_effect(BuildContext& context, const std::string& key, const draft::OwnSection& own, const std::string& help);
/// Of several things a study has chosen one, by a word: tells what that must have and has not (E103, at the place of the word), and which keys of the
/// others are given in vain (E515); their defaults may stand there, as in a resolved study. True where nothing is missing.
bool check_choice(BuildContext& context, const std::vector<OwnKey>& chosen, const std::vector<const std::vector<OwnKey>*>& all,
                  const draft::OwnSection& own, const Given<std::string>& word);
/// Whether any key that must be given is given, or none has to be.
bool has_required_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own);

/// What the study gives the keys, names resolved (E401, E402) and directions made of length 1 (E302); none where a value could not be read or
/// found.
std::optional<OwnValues> own_values(BuildContext& context, const std::vector<OwnKey>& keys, const draft::OwnSection& own);

/// Tells a problem of values at the key that it is about.
void tell_problem(BuildContext& context, const LawProblem& problem, const draft::OwnSection& own, const Place& otherwise);

}  // namespace morula::scenarios
