// Writes the types of what the view `shapes` holds from the program's schema: behaviourlinks schema --messages | node shape_types.mjs
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const title = (id) => `${id[0].toUpperCase()}${id.slice(1)}Content`;
function type_of(schema) {
  if (schema.const !== undefined) return JSON.stringify(schema.const);
  if (schema.type === "boolean") return "boolean";
  if (schema.type === "number" || schema.type === "integer") return "number";
  if (schema.type === "array") return schema.minItems === schema.maxItems && schema.minItems > 0 ? `[${Array(schema.minItems).fill(type_of(schema.items)).join(", ")}]` : `${type_of(schema.items)}[]`;
  throw new Error(`no type for ${JSON.stringify(schema)}`);
}

/// The text of src/space/contents.ts.
export function types_of(schema) {
  const kinds = Object.entries(schema.$defs.shapes);
  let text = "// What the view of the shapes holds, made from its declaration in core/wire by test/shape_types.mjs.\n";
  for (const [id, kind] of kinds) {
    text += `\n/// ${kind.description}\nexport interface ${title(id)} {\n`;
    for (const [name, field] of Object.entries(kind.properties))
      text += `  ${name}${kind.required.includes(name) ? "" : "?"}: ${type_of(field)};${field.description ? ` ///< ${field.description}` : ""}\n`;
    text += "}\n";
  }
  return `${text}\nexport type ShapeContent = ${kinds.map(([id]) => title(id)).join(" | ")};\n`;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) process.stdout.write(types_of(JSON.parse(readFileSync(0, "utf8"))));
