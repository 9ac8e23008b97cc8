// Where the buffers of a glTF file lie: in its own text, or in files of its folder and nowhere else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace brisance {

/// Base64 (RFC 4648); nothing where a character does not belong.
std::optional<std::string> decoded64(std::string_view text);
/// %20 and the like undone; nothing where two hexadecimal digits do not follow.
std::optional<std::string> withoutPercents(std::string_view uri);
/// A plain relative path that does not climb.
bool staysBelow(const std::string& path);
/// Also behind links: the file lies in the folder.
bool liesIn(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace brisance
