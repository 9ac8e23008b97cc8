#include "mesh/gltf_document.h"

#include <cstring>
#include <limits>

#include "base/check.h"
#include "base/durable_file.h"
#include "mesh/gltf_uri.h"
#include "mesh/mesh_text.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "glTF";
constexpr std::uint32_t jsonChunk = 0x4E4F534A, binaryChunk = 0x004E4942;
constexpr std::size_t headerBytes = 12, chunkHeaderBytes = 8;
constexpr int uint8 = 5121, uint16 = 5123, uint32 = 5125, float32 = 5126;  // accessor.componentType

constexpr int deepest = 64;                  // glTF itself nests to about ten
constexpr std::size_t mostValues = 1 << 20;  // of the JSON: each costs the parser up to a hundred bytes

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

std::size_t componentBytes(int type) {
  return type == uint8 ? 1 : type == uint16 ? 2 : type == uint32 || type == float32 ? 4 : 0;
}

}  // namespace

void GltfDocument::fail(const std::string& place, const std::string& trouble) const {
  throw DamagedFile(fmt::format("{}:{}: {}", file_, place, trouble));
}

GltfDocument::GltfDocument(std::string_view bytes, const std::string& file, const fs::path& folder)
    : file_(file), folder_(folder), bytesPresent_(bytes.size()) {
  const std::string_view json = bytes.starts_with(magic) ? splitBinary(bytes) : bytes;
  guardJson(json);
  try {
    root_ = Json::parse(json);
  } catch (const Json::parse_error& trouble) {
    fail(fmt::format("byte {}", trouble.byte), "is not JSON here, must be glTF 2.0");
  } catch (const Json::exception&) {
    fail("byte 0", "holds a number out of range, must be glTF 2.0");
  }
  if (!root_.is_object()) fail("byte 0", "is no JSON object, must be glTF 2.0");
  const Json& asset = root_.contains("asset") ? root_["asset"] : Json::object();
  if (!asset.is_object() || !asset.contains("version") || !asset["version"].is_string() ||
      !asset["version"].get_ref<const std::string&>().starts_with("2."))
    fail("asset", "names no version, must be glTF 2.0");
}

/// Gives the JSON of a binary file and keeps its other chunk.
std::string_view GltfDocument::splitBinary(std::string_view bytes) {
  if (bytes.size() < headerBytes + chunkHeaderBytes) fail("byte 0", "ends early, must hold a header of 20 bytes");
  if (wordAt(bytes, 4) != 2) fail("byte 4", fmt::format("version {}, must be 2", wordAt(bytes, 4)));
  if (wordAt(bytes, 8) > bytes.size())
    fail("byte 8", fmt::format("promises {} bytes, must be at most the file's {}", wordAt(bytes, 8), bytes.size()));
  const auto chunkAt = [&](std::size_t at) {
    const std::size_t length = wordAt(bytes, at), room = bytes.size() - at - chunkHeaderBytes;
    if (length > room)
      fail(fmt::format("byte {}", at), fmt::format("a chunk of {} bytes, must be at most {}", length, room));
    return bytes.substr(at + chunkHeaderBytes, length);
  };
  if (wordAt(bytes, headerBytes + 4) != jsonChunk) fail("byte 16", "another chunk first, must be JSON");
  const std::string_view json = chunkAt(headerBytes);
  const std::size_t next = headerBytes + chunkHeaderBytes + (json.size() + 3) / 4 * 4;
  if (next + chunkHeaderBytes <= bytes.size() && wordAt(bytes, next + 4) == binaryChunk) binary_ = chunkAt(next);
  return json;
}

/// The parser makes an object of every value before anyone can look at them.
void GltfDocument::guardJson(std::string_view json) const {
  int depth = 0;
  std::size_t values = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') inString = !inString;
    if (inString && c == '\\') ++i;
    if (inString) continue;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    values += c == ',' || c == '[' || c == '{';
    if (depth > deepest) fail(fmt::format("byte {}", i), fmt::format("nests deeper than {} levels, must not", deepest));
    if (values > mostValues)
      fail(fmt::format("byte {}", i), fmt::format("more than {} values, must keep numbers in buffers", mostValues));
  }
}

const GltfDocument::Json& GltfDocument::list(const char* name) const {
  static const Json none = Json::array();
  const auto found = root_.find(name);
  if (found == root_.end()) return none;
  if (!found->is_array()) fail(name, "is no list, must be");
  return *found;
}

const GltfDocument::Json& GltfDocument::entry(const char* listName, std::size_t number) const {
  const Json& all = list(listName);
  if (number >= all.size())
    fail(fmt::format("{} {}", listName, number), fmt::format("is not there, must be one of {}", all.size()));
  if (!all[number].is_object()) fail(fmt::format("{} {}", listName, number), "is no object, must be");
  return all[number];
}

std::optional<std::size_t> GltfDocument::number(const Json& object, const char* name) const {
  const auto found = object.find(name);
  if (found == object.end()) return {};
  if (!found->is_number_unsigned()) fail(name, "is no whole number from 0, must be");
  return found->get<std::size_t>();
}

std::string_view GltfDocument::externalBuffer(const std::string& uri, std::size_t number) {
  const std::string place = fmt::format("buffers {}", number);
  const auto name = withoutPercents(uri);
  if (!name || !staysBelow(*name))
    fail(place, fmt::format("uri '{}': must be a file in the folder of this one", shown(uri)));
  const fs::path path = folder_ / *name;
  std::error_code trouble;
  if (folder_.empty() || !fs::is_regular_file(path, trouble))
    fail(place, fmt::format("uri '{}': no such file, must lie beside this one", shown(uri)));
  if (!liesIn(folder_, path))
    fail(place, fmt::format("uri '{}': leads out, must be a file in the folder of this one", shown(uri)));
  const auto [entry, isNew] = externalFiles_.try_emplace(path.lexically_normal().string());
  if (isNew) {
    entry->second = readFile(path);
    bytesPresent_ += entry->second.size();
  }
  return entry->second;
}

std::string_view GltfDocument::buffer(std::size_t number) {
  const Json& buffer = entry("buffers", number);
  const std::string place = fmt::format("buffers {}", number);
  const auto uri = buffer.find("uri");
  if (uri == buffer.end()) {
    if (number != 0) fail(place, "names no uri, must unless it is the first of a binary file");
    return binary_;
  }
  if (!uri->is_string()) fail(place, "uri is no text, must be");
  const auto& text = uri->get_ref<const std::string&>();
  if (!text.starts_with("data:")) return externalBuffer(text, number);
  const auto [entry, isNew] = decoded_.try_emplace(number);
  if (!isNew) return entry->second;
  constexpr std::string_view lead = ";base64,";
  const std::size_t at = text.find(lead);
  auto bytes = at == std::string::npos ? std::nullopt : decoded64(std::string_view(text).substr(at + lead.size()));
  if (!bytes) fail(place, "a data uri that is not base64, must be");
  return entry->second = std::move(*bytes);
}

std::string_view GltfDocument::view(std::size_t number) {
  const Json& view = entry("bufferViews", number);
  const std::string place = fmt::format("bufferViews {}", number);
  const auto bufferNumber = this->number(view, "buffer"), length = this->number(view, "byteLength");
  if (!bufferNumber || !length) fail(place, "must have buffer and byteLength");
  const std::string_view bytes = buffer(*bufferNumber);
  const std::size_t offset = this->number(view, "byteOffset").value_or(0);
  if (offset > bytes.size() || *length > bytes.size() - offset)
    fail(place,
         fmt::format("bytes {} to {} + {}: must be at most the buffer's {}", offset, offset, *length, bytes.size()));
  return bytes.substr(offset, *length);
}

GltfDocument::Rows GltfDocument::rows(std::size_t number, std::size_t width) {
  const Json& accessor = entry("accessors", number);
  const std::string place = fmt::format("accessors {}", number);
  if (accessor.contains("sparse")) fail(place, "is sparse, must be stored whole");
  const auto viewNumber = this->number(accessor, "bufferView");
  if (!viewNumber) fail(place, "names no bufferView, must");
  const std::string types[] = {"", "SCALAR", "VEC2", "VEC3"};
  if (!accessor.contains("type") || accessor["type"] != types[width])
    fail(place, fmt::format("is of another type, must be {}", types[width]));
  const auto promised = this->number(accessor, "count");
  if (!promised) fail(place, "must have a count");
  Rows rows{view(*viewNumber), *promised, 0, 0, false};
  const std::size_t componentType = this->number(accessor, "componentType").value_or(0);
  rows.componentType = componentType > float32 ? 0 : static_cast<int>(componentType);
  rows.normalized = accessor.contains("normalized") && accessor["normalized"] == true;
  const std::size_t row = width * componentBytes(rows.componentType);
  if (row == 0) fail(place, "componentType: must be float or an unsigned integer");
  rows.stride = this->number(entry("bufferViews", *viewNumber), "byteStride").value_or(row);
  if (rows.stride < row) fail(place, fmt::format("byteStride {}: must be at least {}", rows.stride, row));
  const std::size_t offset = this->number(accessor, "byteOffset").value_or(0);
  const std::size_t bytes = rows.bytes.size();
  const std::size_t room = offset > bytes || bytes - offset < row ? 0 : (bytes - offset - row) / rows.stride + 1;
  if (rows.count > room)
    fail(place, fmt::format("promises {} rows, must be at most {} in its bufferView", rows.count, room));
  rows.bytes.remove_prefix(std::min(offset, bytes));
  return rows;
}

namespace {

template <class T>
double componentAt(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double componentAt(const char* at, int type) {
  switch (type) {
    case uint8:
      return componentAt<std::uint8_t>(at);
    case uint16:
      return componentAt<std::uint16_t>(at);
    case uint32:
      return componentAt<std::uint32_t>(at);
    default:
      return componentAt<float>(at);
  }
}

}  // namespace

std::vector<double> GltfDocument::reals(std::size_t accessor, std::size_t width, bool integers) {
  const Rows rows = this->rows(accessor, width);
  const std::string place = fmt::format("accessors {}", accessor);
  const std::size_t bytes = componentBytes(rows.componentType);
  const bool isFloat = rows.componentType == float32;
  if (!isFloat && !(integers && rows.normalized && bytes < 4))
    fail(place, integers ? "must be of float or of normalized bytes or shorts" : "must be of float");
  const double scale = isFloat ? 1 : bytes == 1 ? 255 : 65535;
  std::vector<double> values;
  values.reserve(rows.count * width);
  for (std::size_t n = 0; n < rows.count; ++n)
    for (std::size_t c = 0; c < width; ++c) {
      const double value = componentAt(rows.bytes.data() + n * rows.stride + c * bytes, rows.componentType) / scale;
      if (!std::isfinite(value)) fail(place, fmt::format("row {}: {}, must be a finite number", n, value));
      values.push_back(value);
    }
  return values;
}

std::vector<std::uint32_t> GltfDocument::indices(std::size_t accessor) {
  const Rows rows = this->rows(accessor, 1);
  if (rows.componentType == float32)
    fail(fmt::format("accessors {}", accessor), "indices of float, must be of an unsigned integer");
  std::vector<std::uint32_t> values;
  values.reserve(rows.count);
  for (std::size_t n = 0; n < rows.count; ++n)
    values.push_back(static_cast<std::uint32_t>(componentAt(rows.bytes.data() + n * rows.stride, rows.componentType)));
  return values;
}

}  // namespace brisance
