//! The JSON Schema of scene files, made from the same types that read them.

use super::file::SceneKeys;
use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{Schema, SchemaGenerator};
use serde_json::Value;

/// The JSON Schema (draft 2020-12) of scene files, for editors that complete and check TOML.
#[must_use]
pub fn schema() -> String {
    let settings = SchemaSettings::draft2020_12().with_transform(WithoutNull);
    let schema = SchemaGenerator::new(settings).into_root_schema_for::<SceneKeys>();
    format!("{:#}\n", schema.as_value())
}

/// Says the default of a key in its description, behind the first sentence; those of whole tables are empty.
fn with_default(schema: &mut Schema) {
    let shown = match schema.get("default") {
        Some(Value::String(text)) if !text.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("\"{text}\"")
        }
        Some(Value::String(text)) => text.clone(),
        Some(value @ (Value::Number(_) | Value::Bool(_))) => value.to_string(),
        _ => {
            schema.remove("default");
            return;
        }
    };
    if let Some(Value::String(text)) = schema.get_mut("description") {
        let sentence = text.find(". ").or(text.find(".\n")).unwrap_or(text.len() - 1);
        text.insert_str(sentence, &format!(", {shown} unless given"));
    }
}

/// Removes the choice `null`: an optional key of a TOML file is left out, never null.
#[derive(Debug, Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        with_default(schema);
        if let Some(Value::Array(types)) = schema.get_mut("type") {
            types.retain(|name| name != "null");
            if let [only] = types.as_slice() {
                let only = only.clone();
                schema.insert("type".into(), only);
            }
        }
        if let Some(Value::Array(choices)) = schema.get_mut("anyOf") {
            choices.retain(|choice| choice.get("type") != Some(&Value::from("null")));
            // A choice of one is that one, under the description of the key.
            if let [Value::Object(only)] = choices.as_slice() {
                let only = only.clone();
                schema.remove("anyOf");
                for (key, value) in only {
                    if schema.get(&key).is_none() {
                        schema.insert(key, value);
                    }
                }
            }
        }
    }
}
