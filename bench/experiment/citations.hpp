// Citations by the keys of references.bib, as lines of text and as BibTeX.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

/// "Author, Title, Journal (year)" of a key in references.bib; the key itself when it is not there.
std::string citation(const std::string& key);

/// The BibTeX entry of a key; empty when it is not there.
std::string bibtex(const std::string& key);

/// All keys in references.bib, in alphabetical order.
std::vector<std::string> citation_keys();

/// The keys among a reference text such as "su-qin (92); hairer-lubich-wanner2006 II.1".
std::vector<std::string> keys_in(const std::string& reference);

}  // namespace pfaff
