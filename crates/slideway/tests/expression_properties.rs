//! Expressions: random text never panics, random trees keep their value.

use proptest::prelude::*;
use slideway::expression::{Inferred, Names, Values, parse};

const PARAMETERS: [(&str, f64); 3] = [("a", 1.5), ("b_1", -0.25), ("γ", 3.0)];
const COORDINATES: [(&str, f64); 2] = [("phi", 0.75), ("m", 2.0)];
const TIME: f64 = 1.25;

fn names() -> Names {
    let mut names = Names::new();
    for (name, _) in PARAMETERS {
        names.parameter(name);
    }
    for (name, _) in COORDINATES {
        names.coordinate(name);
    }
    names
}

/// Reads, infers and evaluates; every fault must have a text and a place within the expression.
fn read_without_panic(text: &str) {
    let parameters = PARAMETERS.map(|(_, value)| value);
    let coordinates = COORDINATES.map(|(_, value)| value);
    let values = Values {
        parameters: &parameters,
        coordinates: &coordinates,
        rates: &[0.0, -1.0],
        time: TIME,
        sliding_speed: 0.0,
    };
    let faults = match parse(text, &names()) {
        Ok(expression) => {
            let dimension = expression.dimension(&|_| Inferred::Any).err();
            let value = expression.evaluate(&values);
            assert!(value.as_ref().map_or(true, |value| value.is_finite()), "{text}");
            dimension.into_iter().chain(value.err()).collect()
        }
        Err(faults) => {
            assert!(!faults.is_empty(), "{text}");
            faults
        }
    };
    for fault in faults {
        assert!(text.get(fault.span.clone()).is_some(), "{text}: {fault:?}");
        assert!(!fault.to_string().is_empty() && fault.hint().is_none_or(|hint| !hint.is_empty()));
    }
}

const SOUP: &[&str] = &[
    "1",
    "2.5",
    ".5",
    "3e2",
    "1e308",
    "0",
    "a",
    "b_1",
    "γ",
    "phi",
    "m",
    "t",
    "pi",
    "rate",
    "sin",
    "min",
    "atan2",
    "sqrt",
    "ln",
    "+",
    "-",
    "−",
    "*",
    "/",
    "·",
    "^",
    "²",
    "⁻¹",
    "⁻",
    "(",
    ")",
    ",",
    "kg",
    "N",
    "mm",
    "s",
    "deg",
    "°",
    "%",
    "rpm",
    "e",
    "_",
    ".",
    "unknown",
    "rate(phi)",
    "sin(",
    "2 m",
    " ",
    "  ",
    "\n",
];

/// An expression whose value is computed here in its own way.
#[derive(Clone, Debug)]
enum Tree {
    Number(u16),
    Quantity(u16),
    Name(&'static str, f64),
    Negative(Box<Tree>),
    Sine(Box<Tree>),
    Root(Box<Tree>),
    Smallest(Vec<Tree>),
    Pair(char, Box<Tree>, Box<Tree>),
}

fn trees() -> impl Strategy<Value = Tree> {
    let named = PARAMETERS.into_iter().chain(COORDINATES).chain([("t", TIME), ("pi", std::f64::consts::PI)]);
    let named: Vec<Tree> = named.map(|(name, value)| Tree::Name(name, value)).collect();
    let leaf = prop_oneof![
        any::<u16>().prop_map(Tree::Number),
        any::<u16>().prop_map(Tree::Quantity),
        proptest::sample::select(named),
    ];
    leaf.prop_recursive(6, 60, 3, |part| {
        let operators = proptest::sample::select(vec!['+', '-', '*', '/', '^']);
        prop_oneof![
            part.clone().prop_map(|x| Tree::Negative(Box::new(x))),
            part.clone().prop_map(|x| Tree::Sine(Box::new(x))),
            part.clone().prop_map(|x| Tree::Root(Box::new(x))),
            prop::collection::vec(part.clone(), 2..4).prop_map(Tree::Smallest),
            (operators, part.clone(), part).prop_map(|(sign, x, y)| Tree::Pair(
                sign,
                Box::new(x),
                Box::new(y)
            )),
        ]
    })
}

impl Tree {
    /// The value, unless some part has none.
    fn value(&self) -> Option<f64> {
        let value = match self {
            Self::Number(eighths) => f64::from(*eighths) / 8.0,
            Self::Quantity(millimetres) => f64::from(*millimetres) / 1000.0,
            Self::Name(_, value) => *value,
            Self::Negative(x) => -x.value()?,
            Self::Sine(x) => x.value()?.sin(),
            Self::Root(x) => x.value()?.sqrt(),
            Self::Smallest(parts) => {
                let values: Option<Vec<f64>> = parts.iter().map(Self::value).collect();
                values?.into_iter().fold(f64::INFINITY, f64::min)
            }
            Self::Pair('+', x, y) => x.value()? + y.value()?,
            Self::Pair('-', x, y) => x.value()? - y.value()?,
            Self::Pair('*', x, y) => x.value()? * y.value()?,
            Self::Pair('/', x, y) => x.value()? / y.value()?,
            Self::Pair(_, x, y) => x.value()?.powf(y.value()?),
        };
        value.is_finite().then_some(value)
    }

    /// The text with no parentheses but the necessary ones; `least` is the loosest binding allowed without
    /// them.
    fn text(&self, least: u8) -> String {
        let (binding, text) = match self {
            Self::Number(eighths) => (5, (f64::from(*eighths) / 8.0).to_string()),
            Self::Quantity(millimetres) => (5, format!("({millimetres} mm)")),
            Self::Name(name, _) => (5, (*name).to_owned()),
            Self::Negative(x) => (3, format!("-{}", x.text(3))),
            Self::Sine(x) => (5, format!("sin({})", x.text(0))),
            Self::Root(x) => (5, format!("sqrt({})", x.text(0))),
            Self::Smallest(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| part.text(0)).collect();
                (5, format!("min({})", parts.join(", ")))
            }
            Self::Pair(sign @ ('+' | '-'), x, y) => (1, format!("{} {sign} {}", x.text(1), y.text(2))),
            Self::Pair(sign @ ('*' | '/'), x, y) => (2, format!("{}{sign}{}", x.text(2), y.text(3))),
            Self::Pair(sign, x, y) => (4, format!("{} {sign}{}", x.text(5), y.text(3))),
        };
        if binding < least { format!("({text})") } else { text }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_text_never_panics(text in any::<String>()) {
        read_without_panic(&text);
    }

    #[test]
    fn random_tokens_never_panic(
        parts in prop::collection::vec(proptest::sample::select(SOUP), 0..30),
        blank in any::<bool>(),
    ) {
        read_without_panic(&parts.join(if blank { " " } else { "" }));
    }

    #[test]
    fn random_trees_keep_their_value(tree in trees()) {
        let text = tree.text(0);
        let parameters = PARAMETERS.map(|(_, value)| value);
        let coordinates = COORDINATES.map(|(_, value)| value);
        let values = Values { coordinates: &coordinates, time: TIME, ..Values::of_parameters(&parameters) };
        let expression = parse(&text, &names()).map_err(|faults| TestCaseError::fail(format!("{text}: {faults:?}")))?;
        prop_assert_eq!(expression.evaluate(&values).ok(), tree.value(), "{}", text);
    }
}
