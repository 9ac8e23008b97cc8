// A glTF 2.0 file (Khronos 2021) taken apart with distrust: its JSON, its buffers, its arrays of numbers.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

class GltfDocument {
 public:
  /// Throws DamagedFile. What nests too deeply or holds too many values is refused before the JSON is parsed.
  GltfDocument(std::string_view bytes, const std::string& file, const std::filesystem::path& folder);

  using Json = nlohmann::json;
  const Json& root() const { return root_; }

  /// The list of that name at the root; empty where there is none.
  const Json& list(const char* name) const;
  const Json& entry(const char* listName, std::size_t number) const;
  /// A member that is a number from 0; nothing where it is absent.
  std::optional<std::size_t> number(const Json& object, const char* name) const;

  /// Rows of `width` numbers each, as doubles: of float, or of unsigned integers where `integers` allows them, divided
  /// by their greatest value where the accessor is normalized.
  std::vector<double> reals(std::size_t accessor, std::size_t width, bool integers);
  std::vector<std::uint32_t> indices(std::size_t accessor);
  /// Rows of `width` numbers that the accessor has, and its bytes hold.
  std::size_t count(std::size_t accessor, std::size_t width) { return rows(accessor, width).count; }

  /// Bytes that the file and what it names hold in all.
  std::size_t bytesPresent() const { return bytesPresent_; }
  [[noreturn]] void fail(const std::string& place, const std::string& trouble) const;

 private:
  struct Rows {
    std::string_view bytes;  ///< from the first row
    std::size_t count = 0, stride = 0;
    int componentType = 0;
    bool normalized = false;
  };
  Rows rows(std::size_t accessor, std::size_t width);
  std::string_view view(std::size_t number);
  std::string_view buffer(std::size_t number);
  std::string_view externalBuffer(const std::string& uri, std::size_t number);
  std::string_view splitBinary(std::string_view bytes);
  void guardJson(std::string_view json) const;

  const std::string& file_;
  const std::filesystem::path& folder_;
  Json root_;
  std::string_view binary_;
  std::map<std::size_t, std::string> decoded_;        ///< buffers written as text, by number
  std::map<std::string, std::string> externalFiles_;  ///< by path
  std::size_t bytesPresent_;
};

}  // namespace brisance
