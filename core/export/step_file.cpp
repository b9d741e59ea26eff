// Texts, numbers and lines of STEP files.
#include "core/export/step_file.h"

#include <cstdio>

#include "core/base/text.h"

namespace bl::exporting {

std::string step_text(std::string_view utf8) {
  std::string out = "'";
  for (std::size_t k = 0; k < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[k]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (length == 1) {
      if (lead == '\'') out += "''";
      else if (lead == '\\') out += "\\\\";
      else out += lead < 0x20 || lead == 0x7f ? ' ' : utf8[k];
    } else {
      unsigned code = lead & (length == 2 ? 0x1fu : length == 3 ? 0x0fu : 0x07u);
      for (std::size_t b = 1; b < length && k + b < utf8.size(); ++b)
        code = (code << 6) | (static_cast<unsigned char>(utf8[k + b]) & 0x3fu);
      char escaped[32];
      std::snprintf(escaped, sizeof escaped, code > 0xffff ? "\\X4\\%08X\\X0\\" : "\\X2\\%04X\\X0\\", code);
      out += escaped;
    }
    k += length;
  }
  return out + "'";
}

std::string step_real(double number) {
  std::string text = shortest(number == 0 ? 0 : number);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
  if (const std::size_t place = text.find('e'); place != std::string::npos) text[place] = 'E';
  return text;
}

std::string step_list(const std::vector<std::string>& items) {
  std::string out = "(";
  for (std::size_t k = 0; k < items.size(); ++k) out.append(k == 0 ? "" : ",").append(items[k]);
  return out + ")";
}

std::string step_coordinates(const Point3& p, bool with_height) {
  std::vector<std::string> numbers = {step_real(p.x), step_real(p.y)};
  if (with_height) numbers.push_back(step_real(p.z));
  return step_list(numbers);
}

std::string StepFile::add(std::string_view entity, std::initializer_list<std::string> arguments) {
  const std::string name = "#" + std::to_string(++count_);
  body_.append(name).append("=").append(entity).append(step_list(arguments)).append(";\n");
  return name;
}

std::string StepFile::str(const std::string& description, const std::string& name, const std::string& schema) const {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [DesignTransferView_V1.0]'," + step_text(description) +
         "),'2;1');\nFILE_NAME(" + step_text(name) +
         ",'1970-01-01T00:00:00',(''),(''),'BehaviourLinks','BehaviourLinks','');\nFILE_SCHEMA((" + step_text(schema) +
         "));\nENDSEC;\nDATA;\n" + body_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace bl::exporting
