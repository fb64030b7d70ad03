//! What the types of a model file give as JSON Schema, which `schema.json` has to be.
//!
//! The program reads `schema.json`. If the test says that it differs, this makes it anew:
//! `cargo test -p slideway --lib schema | sed -n '/^{/,/^}/p' > target/schema.json`, to be moved here.

use super::file::{
    BodyTable, Closed, ContactTable, CoordinateTable, DiscOnDiscTable, DriveTable, EventTable, HingeTable,
    SliderTable, StopTable, TableTable,
};
use super::quantity::{
    Direction, Gravity, InSpace, Name, OutlinePlace, PerSide, Place, Quantity, Sides, Through,
};
use super::sections::LoadContents;
use crate::units::UnitSystem;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema, schema_for};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A planar mechanism with sliding joints: one slideway model file.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "only its schema is used: the tables are read one entry at a time")]
struct ModelFile {
    /// One line that says what the mechanism is.
    title: Option<Name>,
    /// What it shows, in as many words as needed.
    description: Option<Name>,
    /// Where it comes from.
    source: Option<Name>,
    /// Acceleration of free fall: a number (downwards, along -y) or its components [x, y] or [x, y, z]. Default: none.
    gravity: Option<Gravity>,
    /// Time of the state, `t` in expressions (s). Default: 0.
    time: Option<Quantity>,
    /// Units of the text output; `--units` overrides it. Default: "as-typed".
    units: Option<UnitSystem>,
    /// Named numbers that any expression may use and that `--set name=value` overrides.
    parameters: Option<BTreeMap<String, Quantity>>,
    /// Functions given by values, which expressions may call: `push(t)` for `[tables.push]`.
    tables: Option<BTreeMap<String, TableTable>>,
    /// Points in world coordinates [x, y] of the reference drawing, or [x, y, z] with z out of it.
    points: Option<BTreeMap<String, InSpace>>,
    /// The rigid bodies. `ground` needs no entry: it owns every point that no body owns.
    bodies: BTreeMap<String, BodyTable>,
    /// Hinges and sliding joints, each between two bodies or a body and `ground`.
    joints: BTreeMap<String, JointTable>,
    /// Forces, torques, springs and dampers.
    loads: Option<BTreeMap<String, LoadContents>>,
    /// Prescribed motions, each with the unknown force or torque that produces it.
    drives: Option<BTreeMap<String, DriveTable>>,
    /// The chosen coordinates: as many as there are degrees of freedom.
    coordinates: Option<BTreeMap<String, CoordinateTable>>,
    /// What a motion in time is watched for, beside what the joints do.
    events: Option<BTreeMap<String, EventTable>>,
}

/// A joint between two bodies.
#[derive(JsonSchema)]
#[schemars(tag = "type", rename_all = "snake_case")]
#[expect(dead_code, reason = "only its schema is used")]
enum JointTable {
    /// A hinge, without friction unless it is given.
    Hinge(Box<HingeTable>),
    /// A carriage, sledge or bushing with a contact at each end.
    BlockSlider(Box<BlockSliderTable>),
    /// A slider pressed on one side along its whole length: one normal force and a couple.
    GuidedSlider(Box<GuidedSliderTable>),
    /// A pin in a slot, free to rotate: one contact.
    PinInSlot(Box<PinInSlotTable>),
    /// A corner on a straight face, which it may leave.
    CornerOnFace(Box<CornerOnFaceTable>),
    /// A block on a straight face, which both of its corners may leave.
    BlockOnFace(Box<BlockOnFaceTable>),
    /// A disc on a straight face, which it may leave.
    DiscOnFace(Box<DiscOnFaceTable>),
    /// A disc on a disc, or in a hole, which it may leave.
    DiscOnDisc(Box<DiscContactTable>),
}

/// A corner, a block or a disc on a face, which it may leave.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "only its schema is used: it is read as that of a slider")]
struct OnFaceTable {
    /// The body that has the corner, the base or the disc, or "ground".
    block: Name,
    /// The body that has the face. Default: "ground".
    guide: Option<Name>,
    /// The corner, or the middle of the base, in the drawing: a point's name or [x, y].
    at: Option<Place>,
    /// The centre of a disc in the drawing: a point's name or [x, y].
    centre: Option<Place>,
    /// The radius of a disc.
    radius: Option<Quantity>,
    /// What touches in the state to be solved: `true` (default), `false`, or of a block `["front"]` or `["rear"]`.
    closed: Option<Closed>,
    /// `true`: it does not slip in the state to be solved (a disc rolls), so that it needs one coordinate less. Default: `false`.
    sticks: Option<bool>,
    /// Direction of positive sliding along a face without ends: an angle from the x axis, or two points
    /// `["from", "to"]`. The block is on its left.
    along: Option<Direction>,
    /// The ends of a face, two points `["from", "to"]`, in place of `along`.
    face: Option<[Name; 2]>,
    /// Distance of both corners of a block.
    length: Option<Quantity>,
    /// The corner at the end in the direction of sliding: what differs there.
    front: Option<CornerTable>,
    /// The corner at the other end: what differs there.
    rear: Option<CornerTable>,
}

/// What a corner may have.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "only its schema is used: it is read as that of a contact")]
struct CornerTable {
    /// Kinetic friction coefficient.
    mu: Option<Quantity>,
    /// Static friction coefficient, not below `mu`. Default: `mu`.
    mu_static: Option<Quantity>,
    /// Stiffness of the contact (N/m).
    stiffness: Option<Quantity>,
    /// Coefficient of restitution, from 0 to 1: the part of the velocity with which it reaches its face that it has when
    /// it leaves it again, or less, since an impact never returns more work than it has taken. Default: 0.
    restitution: Option<Quantity>,
}

/// Where a contact is in the cross-section of its guide.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "only its schema is used: it is read as that of a contact")]
struct SectionTable {
    /// How far it is from the guide's line along n, rot90 of `along`. Default: 0.
    aside: Option<Quantity>,
    /// How far it is out of the drawing. Default: 0.
    z: Option<Quantity>,
    /// Distance of its two faces along its normal. Default: that of the joint, 0 where the normal leans out of the drawing.
    height: Option<Quantity>,
    /// Direction of its normal in the cross-section, an angle from n towards z: "90 deg" carries along z. Default: 0.
    normal: Option<Quantity>,
    /// `true`: it has one face, on the side from which a positive normal force comes, and may lift off it. Default: `false`.
    one_sided: Option<bool>,
}

/// A table that has some keys of others.
macro_rules! some_keys {
    ($name:ident: $($of:ty),+; without $without:expr; required $required:expr; $doc:literal) => {
        pub(super) struct $name;

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                some_keys(&[$(<$of>::json_schema(generator)),+], &$without, &$required, $doc)
            }
        }
    };
}

some_keys!(BlockSliderTable: ContactTable, SliderTable; without ["carried_by"]; required ["along", "length"];
    "A block with a contact at each end.");
some_keys!(GuidedSliderTable: ContactTable, SliderTable; without ["carried_by", "front", "rear", "supports", "rests_on", "section"];
    required ["along", "length"]; "A slider with one normal force and a couple.");
some_keys!(PinInSlotTable: ContactTable, SliderTable;
    without ["carried_by", "front", "rear", "supports", "rests_on", "section", "length", "height", "fit", "preload_line"];
    required ["along"]; "A pin in a slot.");
some_keys!(CornerOnFaceTable: CornerTable, OnFaceTable; without ["front", "rear", "length", "centre", "radius"];
    required ["at"]; "A corner on a straight face, which it may leave.");
some_keys!(BlockOnFaceTable: CornerTable, OnFaceTable; without ["centre", "radius"]; required ["at", "length"];
    "A block on a straight face, which both of its corners may leave.");
some_keys!(DiscOnFaceTable: CornerTable, OnFaceTable; without ["front", "rear", "length", "at"];
    required ["centre", "radius"]; "A disc on a straight face, which it may leave.");
some_keys!(DiscContactTable: CornerTable, DiscOnDiscTable; without []; required [];
    "A disc on a disc, or in a hole, which it may leave.");
some_keys!(EndTable: ContactTable, SectionTable; without ["at"]; required []; "What differs at one end of a block.");
some_keys!(SupportTable: ContactTable, SectionTable; without []; required ["at"]; "A further contact of a block.");
some_keys!(StopAtEndTable: StopTable; without ["least", "greatest"]; required [];
    "What stops a block at one end of its travel.");

/// The keys of tables (those of the last where several have one), without some of them, and some more of them required.
fn some_keys(tables: &[Schema], without: &[&str], required: &[&str], description: &str) -> Schema {
    let mut keys = serde_json::Map::new();
    let mut needed: Vec<serde_json::Value> = Vec::new();
    for table in tables {
        let properties = table.get("properties").and_then(|keys| keys.as_object()).expect("a table has keys");
        keys.extend(properties.clone());
        needed.extend(table.get("required").and_then(|keys| keys.as_array()).into_iter().flatten().cloned());
    }
    needed.extend(required.iter().map(|&key| key.into()));
    keys.retain(|key, _| !without.contains(&key.as_str()));
    for key in required {
        let key = keys.get_mut(*key).expect("a required key is one of the table");
        if let Some(not_null) = key["anyOf"].as_array().and_then(|kinds| kinds.first()).cloned() {
            let description = key["description"].clone();
            *key = serde_json::json!({ "description": description });
            key.as_object_mut()
                .expect("an object")
                .extend(not_null.as_object().expect("a reference").clone());
        }
    }
    let mut schema = json_schema!({
        "additionalProperties": false,
        "description": description,
        "properties": keys,
        "type": "object"
    });
    if !needed.is_empty() {
        schema.insert("required".to_owned(), needed.into());
    }
    schema
}

impl JsonSchema for Name {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Name".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}

impl JsonSchema for Quantity {
    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A plain number in SI units, a number with a unit such as \"25 mm\", or an expression such as \"2*l*cos(alpha)\".",
            "type": ["number", "string"]
        })
    }
}

impl JsonSchema for InSpace {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "InSpace".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "items": generator.subschema_for::<Quantity>(),
            "maxItems": 3,
            "minItems": 2,
            "type": "array"
        })
    }
}

/// Values that are either of two forms.
macro_rules! either {
    ($($name:ident: $first:ty, $second:ty;)+) => {
        $(impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                json_schema!({
                    "anyOf": [generator.subschema_for::<$first>(), generator.subschema_for::<$second>()]
                })
            }
        })+
    };
}

either! {
    Place: Name, InSpace;
    OutlinePlace: Place, Through;
    Direction: Quantity, [Name; 2];
    PerSide: Quantity, Sides;
    Gravity: Quantity, InSpace;
}

#[test]
fn the_schema_that_is_read_is_that_of_the_types() {
    let mut schema = schema_for!(ModelFile);
    schema.insert("title".to_owned(), "Slideway model".into());
    let mut schema = serde_json::Value::from(schema);
    join_lines(&mut schema);
    let made = format!("{schema:#}\n");
    assert!(made == super::SCHEMA, "schema.json is not what the types give, which is\n{made}");
}

/// Puts the lines of each paragraph of a description together: where comments are wrapped says nothing to an editor.
fn join_lines(schema: &mut serde_json::Value) {
    use serde_json::Value;
    match schema {
        Value::Object(entries) => {
            for (name, value) in entries {
                match value {
                    Value::String(text) if name == "description" => {
                        let paragraphs: Vec<String> =
                            text.split("\n\n").map(|lines| lines.replace('\n', " ")).collect();
                        *text = paragraphs.join("\n\n");
                    }
                    _ => join_lines(value),
                }
            }
        }
        Value::Array(values) => values.iter_mut().for_each(join_lines),
        _ => {}
    }
}
