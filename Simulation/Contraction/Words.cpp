// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Words.h"

#include "Repair/Fields.h"

namespace myotet::contraction {

std::string known_are(const std::string& word, const std::vector<std::string>& candidates) {
    if (candidates.empty()) return "; there are none";
    const std::string near = repair::nearest_word(word, candidates);
    const std::string all = list_of(candidates);
    return near.empty() ? "; known are " + all : "; did you mean '" + near + "'? Known are " + all;
}

}  // namespace myotet::contraction
