//! Expressions: values, units, dimensions, faults.

use slideway::interval::Interval;
use std::f64::consts::{E, FRAC_PI_2, PI};

use rstest::rstest;
use slideway::expression::{
    Dimension, Expression, ExpressionFault, ExpressionFaultKind as Kind, Inferred, MAX_DEPTH, MAX_LENGTH,
    Names, Symbol, Values, is_reserved, is_valid_name, parse,
};

const VALUES: Values<'_> = Values {
    parameters: &[2.0, 3.0, 5.0, 7.0],
    coordinates: &[0.5, 0.25],
    rates: &[11.0, 13.0],
    time: 4.0,
    sliding_speed: 0.125,
};

/// Parameters l, mu, m, g; coordinates phi, s.
fn names() -> Names {
    let mut names = Names::new();
    for parameter in ["l", "mu", "m", "g"] {
        names.parameter(parameter);
    }
    for coordinate in ["phi", "s"] {
        names.coordinate(coordinate);
    }
    names
}

fn read(text: &str) -> Expression {
    parse(text, &names()).unwrap_or_else(|faults| panic!("{text}: {faults:?}"))
}

fn value(text: &str) -> f64 {
    read(text).evaluate(&VALUES).unwrap_or_else(|fault| panic!("{text}: {fault}"))
}

fn faults(text: &str) -> Vec<ExpressionFault> {
    parse(text, &names()).err().unwrap_or_else(|| panic!("{text} has no fault"))
}

fn only_fault(text: &str) -> ExpressionFault {
    let mut faults = faults(text);
    assert_eq!(faults.len(), 1, "{text}: {faults:?}");
    faults.remove(0)
}

#[rstest]
#[case("1", 1.0)]
#[case("2*sliding_speed", 0.25)]
#[case("1.5", 1.5)]
#[case(".5", 0.5)]
#[case("2.", 2.0)]
#[case("1e-3", 1e-3)]
#[case("1E+3", 1e3)]
#[case("1e−3", 1e-3)]
#[case("1_000.5", 1000.5)]
#[case("-2^2", -4.0)]
#[case("(-2)^2", 4.0)]
#[case("2^3^2", 512.0)]
#[case("2^-1", 0.5)]
#[case("2^-2^2", 0.0625)]
#[case("2^-1*6", 3.0)]
#[case("2²", 4.0)]
#[case("-l²", -4.0)]
#[case("l⁻¹", 0.5)]
#[case("2^l²", 16.0)]
#[case("10 - 4 - 3", 3.0)]
#[case("24/4/3", 2.0)]
#[case("2 + 3*4", 14.0)]
#[case("2*-3", -6.0)]
#[case("2 − 3", -1.0)]
#[case("--2", 2.0)]
#[case("+2", 2.0)]
#[case("2·l", 4.0)]
#[case("2/m", 0.4)]
#[case("m*g", 35.0)]
#[case("t + rate(phi) + rate( s )", 28.0)]
#[case("phi - s", 0.25)]
#[case("pi", PI)]
#[case("(((l)))", 2.0)]
#[case("\n 2\t*\n3 ", 6.0)]
fn arithmetic(#[case] text: &str, #[case] expected: f64) {
    assert_eq!(value(text), expected, "{text}");
}

#[rstest]
#[case("sin(pi/2)", 1.0)]
#[case("cos(0)", 1.0)]
#[case("tan(0)", 0.0)]
#[case("asin(1)", FRAC_PI_2)]
#[case("acos(1)", 0.0)]
#[case("atan(0)", 0.0)]
#[case("atan2(1, 0)", FRAC_PI_2)]
#[case("sinh(0)", 0.0)]
#[case("cosh(0)", 1.0)]
#[case("tanh(0)", 0.0)]
#[case("sqrt(9)", 3.0)]
#[case("abs(-3)", 3.0)]
#[case("sign(-3)", -1.0)]
#[case("sign(0)", 0.0)]
#[case("exp(1)", E)]
#[case("ln(exp(2))", 2.0)]
#[case("log10(1000)", 3.0)]
#[case("min(3, 2)", 2.0)]
#[case("max(1, 4, 3, 2)", 4.0)]
#[case("hypot(3, 4)", 5.0)]
#[case("step(-1e-9)", 0.0)]
#[case("step(0)", 1.0)]
#[case("2*min(1 + 1, hypot(3, 1 + 3))", 4.0)]
fn functions(#[case] text: &str, #[case] expected: f64) {
    assert!((value(text) - expected).abs() < 1e-15, "{text}: {}", value(text));
}

#[rstest]
#[case("80 deg", 80_f64.to_radians(), Dimension::ANGLE)]
#[case("180°", PI, Dimension::ANGLE)]
#[case("35 mm", 0.035, Dimension::LENGTH)]
#[case("35mm", 0.035, Dimension::LENGTH)]
#[case("2 in", 0.0508, Dimension::LENGTH)]
#[case("3 µm", 3e-6, Dimension::LENGTH)]
#[case("3 kN", 3000.0, Dimension::FORCE)]
#[case("9.81 m/s^2 ", 9.81, Dimension::ACCELERATION)]
#[case("9.81 m s⁻²", 9.81, Dimension::ACCELERATION)]
#[case("5 N m", 5.0, Dimension::TORQUE)]
#[case("5 Nm", 5.0, Dimension::TORQUE)]
#[case("5 N*mm", 0.005, Dimension::TORQUE)]
#[case("5 N·mm", 0.005, Dimension::TORQUE)]
#[case("2 kg cm^2", 2e-4, Dimension::MOMENT_OF_INERTIA)]
#[case("2 kg m²", 2.0, Dimension::MOMENT_OF_INERTIA)]
#[case("1.5e3 N/mm", 1.5e6, Dimension::STIFFNESS)]
#[case("2 N s/mm", 2e3, Dimension::DAMPING)]
// NIST SP 811, appendix B.8; 550 ft lbf/s in 50 digits by Python's decimal.
#[case("1 lb", 0.453_592_37, Dimension::MASS)]
#[case("16 oz", 0.453_592_37, Dimension::MASS)]
#[case("1 lbf", 4.448_221_615_260_5, Dimension::FORCE)]
#[case("16 ozf", 4.448_221_615_260_5, Dimension::FORCE)]
#[case("1 kgf", 9.806_65, Dimension::FORCE)]
#[case("1 lbf in", 0.112_984_829_027_616_7, Dimension::TORQUE)]
#[case("1 lbf ft", 1.355_817_948_331_400_4, Dimension::TORQUE)]
#[case("1 psi", 6_894.757_293_168_362, Dimension::PRESSURE)]
#[case("1 hp", 745.699_871_582_270_2, Dimension::POWER)]
#[case("30 rpm", PI, Dimension::ANGULAR_VELOCITY)]
#[case("30 rpm*2", 2.0 * PI, Dimension::ANGULAR_VELOCITY)]
#[case("6 m/min", 0.1, Dimension::VELOCITY)]
#[case("5 %", 0.05, Dimension::NONE)]
#[case("2 Hz", 2.0, Dimension::FREQUENCY)]
#[case("-2 m^2", -2.0, Dimension::AREA)]
#[case("(3 m)^2", 9.0, Dimension::AREA)]
#[case("2 m*min(3, 4)", 6.0, Dimension::LENGTH)]
#[case("1e3mm", 1.0, Dimension::LENGTH)]
fn quantities(#[case] text: &str, #[case] expected: f64, #[case] dimension: Dimension) {
    let expression = parse(text, &Names::new()).unwrap_or_else(|faults| panic!("{text}: {faults:?}"));
    assert_eq!(expression.evaluate(&VALUES), Ok(expected), "{text}");
    assert_eq!(expression.dimension(&|_| Inferred::Any), Ok(Inferred::Known(dimension)), "{text}");
}

#[rstest]
#[case("3 N*l", 6.0)]
#[case("3 rad/s*t", 12.0)]
// A slash without blanks goes on with a unit although `m` and `s` are names of the model, too.
#[case("5 N/m", 5.0)]
#[case("9.81 m/s^2", 9.81)]
#[case("(2 m)*g", 14.0)]
#[case("8 kg/l", 4.0)]
#[case("9.81 m/ms^2*pi", 9.81 * 1e6 * PI)]
fn a_name_that_is_no_unit_ends_the_unit(#[case] text: &str, #[case] expected: f64) {
    let mut names = Names::new();
    for parameter in ["l", "mu", "m", "g"] {
        names.parameter(parameter);
    }
    assert_eq!(parse(text, &names).map(|expression| expression.evaluate(&VALUES)), Ok(Ok(expected)));
}

fn of(symbol: Symbol) -> Inferred {
    match symbol {
        Symbol::Parameter(0) | Symbol::Coordinate(1) => Inferred::Known(Dimension::LENGTH),
        Symbol::Parameter(2) => Inferred::Known(Dimension::MASS),
        Symbol::Parameter(3) => Inferred::Known(Dimension::ACCELERATION),
        Symbol::Parameter(_) => Inferred::Any,
        Symbol::Coordinate(_) => Inferred::Known(Dimension::ANGLE),
        Symbol::Rate(_) | Symbol::SlidingSpeed => Inferred::Known(Dimension::VELOCITY),
        Symbol::Time => Inferred::Known(Dimension::TIME),
    }
}

#[rstest]
#[case("2", Inferred::Number)]
#[case("2*pi + 1", Inferred::Number)]
#[case("1 + 2 m", Inferred::Known(Dimension::LENGTH))]
#[case("m*g", Inferred::Known(Dimension::FORCE))]
#[case("mu*m*g", Inferred::Any)]
#[case("mu + m*g", Inferred::Known(Dimension::FORCE))]
#[case("mu + 1", Inferred::Any)]
#[case("2*l", Inferred::Known(Dimension::LENGTH))]
#[case("2/t", Inferred::Known(Dimension::FREQUENCY))]
#[case("s/t - rate(s)", Inferred::Known(Dimension::VELOCITY))]
#[case("sqrt(l*s)", Inferred::Known(Dimension::LENGTH))]
#[case("sqrt(2)", Inferred::Number)]
#[case("(l*s)^0.5", Inferred::Known(Dimension::LENGTH))]
#[case("(l*s)^(3/2)", Inferred::Known(Dimension { length: 3, mass: 0, time: 0 }))]
#[case("l^-2", Inferred::Known(Dimension { length: -2, mass: 0, time: 0 }))]
#[case("phi^mu", Inferred::Known(Dimension::NONE))]
#[case("2^3", Inferred::Number)]
#[case("l*sin(s/l)", Inferred::Known(Dimension::LENGTH))]
#[case("atan2(s, l)", Inferred::Known(Dimension::ANGLE))]
#[case("hypot(s, l)", Inferred::Known(Dimension::LENGTH))]
#[case("max(s, l, 0)", Inferred::Known(Dimension::LENGTH))]
#[case("abs(s)*sign(s)*step(t)", Inferred::Known(Dimension::LENGTH))]
fn dimensions(#[case] text: &str, #[case] expected: Inferred) {
    assert_eq!(read(text).dimension(&of), Ok(expected), "{text}");
}

#[rstest]
#[case("m + l + l", 0..5, "`+` cannot combine a mass and a length")]
#[case("l - 3 deg", 0..9, "`-` cannot combine a length and an angle or pure number")]
#[case("atan2(m, l)", 0..11, "`atan2` cannot combine a mass and a length")]
#[case("2*sin(l)", 6..7, "`sin` takes an angle or pure number, not a length")]
#[case("sqrt(l)", 0..7, "a length to the power 0.5 has no meaningful dimension")]
#[case("l^1.5", 0..5, "a length to the power 1.5 has no meaningful dimension")]
#[case("l^mu", 0..4, "a length to a power that varies has no fixed dimension")]
#[case("2^l", 2..3, "an exponent must be a pure number, not a length")]
#[case("l^127*l", 0..7, "the exponents of the dimension are too large")]
#[case("l^1e9", 0..5, "the exponents of the dimension are too large")]
fn contradicting_dimensions(#[case] text: &str, #[case] span: std::ops::Range<usize>, #[case] message: &str) {
    let fault = read(text).dimension(&of).err();
    let found = fault.map(|fault| (fault.to_string(), fault.span));
    assert_eq!(found, Some((message.to_owned(), span)), "{text}");
}

#[rstest]
#[case(Dimension::NONE, "an angle or pure number")]
#[case(Dimension::FORCE, "a force")]
#[case(Dimension { length: 2, mass: 1, time: -1 }, "kg m^2/s")]
#[case(Dimension { length: -1, mass: 2, time: -3 }, "kg^2/(m s^3)")]
#[case(Dimension { length: -1, mass: 0, time: 0 }, "1/m")]
#[case(Dimension { length: 0, mass: 0, time: 2 }, "s^2")]
#[case(Dimension { length: i8::MIN, mass: 0, time: 0 }, "1/m^128")]
fn names_of_dimensions(#[case] dimension: Dimension, #[case] expected: &str) {
    assert_eq!(dimension.to_string(), expected);
}

#[rstest]
#[case("", 0..0, Kind::Empty)]
#[case("  ", 0..2, Kind::Empty)]
#[case("2 $ 3", 2..3, Kind::UnexpectedCharacter { character: '$' })]
#[case("l⁻", 1..4, Kind::UnexpectedCharacter { character: '⁻' })]
#[case("1e999", 0..5, Kind::NumberTooLarge)]
#[case("1e308 km", 0..8, Kind::NumberTooLarge)]
#[case("l⁹⁹⁹", 1..10, Kind::NumberTooLarge)]
#[case("2 +", 3..3, Kind::UnexpectedEnd)]
#[case("2 + )", 4..5, Kind::ExpectedOperand { found: ")".into() })]
#[case("2 ** 3", 3..4, Kind::ExpectedOperand { found: "*".into() })]
#[case("l g", 2..3, Kind::ExpectedOperator { found: "g".into() })]
#[case("2 (l)", 2..3, Kind::ExpectedOperator { found: "(".into() })]
#[case("1,5", 1..2, Kind::ExpectedOperator { found: ",".into() })]
#[case("2 + (l", 4..5, Kind::UnclosedParenthesis)]
#[case("sin(l", 3..4, Kind::UnclosedParenthesis)]
#[case("l)", 1..2, Kind::UnmatchedParenthesis)]
#[case("fo", 0..2, Kind::UnknownName { name: "fo".into(), nearest: None, is_unit: false })]
#[case("ph", 0..2, Kind::UnknownName { name: "ph".into(), nearest: Some("phi".into()), is_unit: false })]
#[case("5*kg", 2..4, Kind::UnknownName { name: "kg".into(), nearest: Some("g".into()), is_unit: true })]
#[case("sen(l)", 0..3, Kind::UnknownFunction { name: "sen".into(), nearest: Some("sin".into()), is_name: false })]
#[case("l(2)", 0..1, Kind::UnknownFunction { name: "l".into(), nearest: None, is_name: true })]
#[case("sin*2", 0..3, Kind::FunctionWithoutArguments { name: "sin".into() })]
#[case("sin()", 0..5, Kind::WrongArgumentCount { function: "sin".into(), expected: "one argument", found: 0 })]
#[case("1+atan2(1)", 2..10,
    Kind::WrongArgumentCount { function: "atan2".into(), expected: "two arguments", found: 1 })]
#[case("max(1)", 0..6,
    Kind::WrongArgumentCount { function: "max".into(), expected: "two or more arguments", found: 1 })]
#[case("rate(2*l)", 0..5, Kind::RateArgument)]
#[case("rate(l)", 5..6, Kind::NotACoordinate { name: "l".into(), nearest: None })]
#[case("rate(t)", 5..6, Kind::NotACoordinate { name: "t".into(), nearest: None })]
#[case("rate(psi)", 5..8,
    Kind::UnknownName { name: "psi".into(), nearest: Some("phi".into()), is_unit: false })]
#[case("5 N x", 4..5, Kind::UnknownUnit { unit: "x".into(), nearest: vec![], is_name: false })]
#[case("5 N l", 4..5, Kind::UnknownUnit { unit: "l".into(), nearest: vec![], is_name: true })]
#[case("3 KN", 2..4, Kind::UnknownUnit { unit: "KN".into(), nearest: vec!["kN"], is_name: false })]
#[case("3 Kg", 2..4, Kind::UnknownUnit { unit: "Kg".into(), nearest: vec!["kg"], is_name: false })]
#[case("2 m^l", 3..5, Kind::UnitExponent)]
#[case("2 mm^2.5", 4..8, Kind::UnitExponent)]
#[case("2 mm^2^3", 4..6, Kind::UnitExponent)]
#[case("2 mm²^3", 4..6, Kind::UnitExponent)]
#[case("5 N*m", 4..5,
    Kind::AmbiguousUnit { name: "m".into(), as_name: "(5 N)*m".into(), as_unit: "5 N m".into() })]
#[case("9.81 m / s^2", 9..10,
    Kind::AmbiguousUnit { name: "s".into(), as_name: "(9.81 m)/s".into(), as_unit: "9.81 m s^-2".into() })]
#[case("1 m^127 m", 0..9, Kind::DimensionTooLarge)]
fn misspelt(#[case] text: &str, #[case] span: std::ops::Range<usize>, #[case] kind: Kind) {
    assert_eq!(only_fault(text), ExpressionFault { kind, span }, "{text}");
}

#[rstest]
#[case("lenght_2 + [", "use `(` and `)` only")]
#[case("2 l", "write `*` to multiply")]
#[case("2 sin(l)", "write `*` to multiply")]
#[case("l (2)", "write `*` to multiply")]
#[case("2**l", "write `^` for a power")]
#[case("1,5", "write decimals with a point, as in 1.5")]
#[case("2e", "an exponent needs digits, and no space before it, as in `1e3`")]
#[case("1 e3", "an exponent needs digits, and no space before it, as in `1e3`")]
#[case("3 mn", "did you mean `mN` or `MN`?")]
#[case("Pi", "did you mean `pi`?")]
#[case("5 N / m", "write `(5 N)/m` for the model's `m`, `5 N m^-1` for the unit")]
#[case("3*kg", "`kg` is a unit: it must follow a number, as in `1 kg`")]
fn hints(#[case] text: &str, #[case] hint: &str) {
    assert_eq!(only_fault(text).hint().as_deref(), Some(hint), "{text}");
}

#[test]
fn every_spelling_fault_and_every_unknown_name_is_reported() {
    let spans: Vec<_> = faults("2 $ 3 # 1e999").into_iter().map(|fault| fault.span).collect();
    assert_eq!(spans, [2..3, 6..7, 8..13]);
    let spans: Vec<_> =
        faults("one + 2 two*sin(3, l) - three(4) +").into_iter().map(|fault| fault.span).collect();
    assert_eq!(spans, [0..3, 8..11, 12..21, 24..29, 34..34]);
}

#[rstest]
#[case("2 + 1/(l - 2)", 4..13, Kind::DivisionByZero { numerator: 1.0 })]
#[case("sqrt(1 - l)", 0..11, Kind::NotFinite { operation: "sqrt".into(), arguments: vec![-1.0] })]
#[case("ln(0)", 0..5, Kind::NotFinite { operation: "ln".into(), arguments: vec![0.0] })]
#[case("1 + (-2)^0.5", 4..12, Kind::NotFinite { operation: "^".into(), arguments: vec![-2.0, 0.5] })]
#[case("0^-1", 0..4, Kind::NotFinite { operation: "^".into(), arguments: vec![0.0, -1.0] })]
#[case("1e300*1e300", 0..11, Kind::NotFinite { operation: "*".into(), arguments: vec![1e300, 1e300] })]
#[case("min(1, 1/0)", 7..10, Kind::DivisionByZero { numerator: 1.0 })]
fn without_a_finite_value(#[case] text: &str, #[case] span: std::ops::Range<usize>, #[case] kind: Kind) {
    assert_eq!(read(text).evaluate(&VALUES), Err(ExpressionFault { kind, span }), "{text}");
}

#[test]
fn missing_and_infinite_values_are_faults() {
    let none = Values { time: f64::INFINITY, ..Values::of_parameters(&[]) };
    let kind = |text: &str| read(text).evaluate(&none).map_err(|fault| fault.kind);
    assert_eq!(kind("mu"), Err(Kind::MissingValue { symbol: Symbol::Parameter(1) }));
    assert_eq!(kind("rate(s)"), Err(Kind::MissingValue { symbol: Symbol::Rate(1) }));
    assert_eq!(kind("t"), Err(Kind::ValueNotFinite { value: f64::INFINITY }));
    assert!(Expression::constant(f64::NAN).evaluate(&VALUES).is_err());
}

#[test]
fn symbols_and_constants() {
    assert!(read("2*pi + sin(3 deg)").is_constant());
    assert!(!read("2*t").is_constant());
    let symbols: Vec<_> = read("mu + rate(phi)*s").symbols().collect();
    assert_eq!(
        symbols,
        [(Symbol::Parameter(1), 0..2), (Symbol::Rate(0), 5..14), (Symbol::Coordinate(1), 15..16)]
    );
}

#[test]
fn reserved_and_valid_names() {
    assert!(["t", "pi", "rate", "sliding_speed", "min", "log10"].into_iter().all(is_reserved));
    assert!(!["T", "m", "l", ""].into_iter().any(is_reserved));
    assert!(["l", "_x", "l_1", "α2", "mu"].into_iter().all(is_valid_name));
    assert!(!["", "1l", "a-b", "x y", "x²", "°"].into_iter().any(is_valid_name));
}

#[test]
fn a_reserved_or_repeated_name_keeps_its_meaning() {
    let mut names = Names::new();
    assert_eq!(names.parameter("t"), Symbol::Parameter(0));
    assert_eq!(names.parameter("a"), Symbol::Parameter(1));
    assert_eq!(names.coordinate("a"), Symbol::Coordinate(0));
    assert_eq!(names.lookup("t"), Some(Symbol::Time));
    assert_eq!(names.lookup("a"), Some(Symbol::Parameter(1)));
}

#[rstest]
#[case("(")]
#[case("-")]
#[case("2^")]
#[case("sin(")]
#[case("1+(")]
fn too_deep(#[case] level: &str) {
    let text = level.repeat(MAX_LENGTH / level.len());
    assert_eq!(only_fault(&text).kind, Kind::TooDeep { limit: MAX_DEPTH });
}

#[test]
fn too_long() {
    let text = " ".repeat(MAX_LENGTH) + "1";
    assert_eq!(only_fault(&text).kind, Kind::TooLong { length: MAX_LENGTH + 1, limit: MAX_LENGTH });
}

#[test]
fn long_and_deep_within_the_limits() {
    assert_eq!(value(&format!("1{}", "+1".repeat(4000))), 4001.0);
    let levels = MAX_DEPTH / 2 - 1;
    let text = format!("{}1{}", "1+(".repeat(levels), ")".repeat(levels));
    assert_eq!(value(&text), levels as f64 + 1.0);
    let levels = MAX_DEPTH - 1;
    let text = format!("{}1²{}", "hypot(0, ".repeat(levels), ")".repeat(levels));
    assert_eq!(value(&text), 1.0);
    assert_eq!(read(&text).dimension(&of), Ok(Inferred::Number));
}

/// The interval of an expression of time.
fn interval_at(time: Interval, text: &str) -> Result<Interval, ExpressionFault> {
    let values = Values { time, ..Values::of_parameters(&[]) };
    parse(text, &Names::new()).expect("a sound expression").evaluate(&values)
}

/// The interval of an expression without symbols.
fn interval(text: &str) -> Interval {
    interval_at(Interval::ZERO, text).expect("a value")
}

#[test]
fn decimals_that_are_numbers_are_exact() {
    let exact =
        ["0", "0.0", "1", "0.5", "-0.375", "1e3", "2_500", "500 mm", "12.5 %", "250e-3", "1e22", "3 kN"];
    for text in exact {
        assert_eq!(interval(text).width(), 0.0, "{text}");
    }
}

#[test]
fn other_decimals_lie_between_neighbouring_numbers() {
    for text in [
        "0.1",
        "1e-3",
        "35 mm",
        "0.3333",
        "9.81 m/s^2",
        "1e23",
        "123456789012345678901234567890",
        "80 deg",
        "pi",
    ] {
        let (found, rounded) = (interval(text), interval(text).middle());
        assert!(found.lower() < found.upper(), "{text}");
        assert!(found.width() <= 8.0 * f64::EPSILON * rounded, "{text}");
    }
    // 0.1 in f64 is above the decimal, 0.3 below.
    assert!(interval("0.1*10").contains(1.0) && interval("0.1 + 0.2 - 0.3").contains(0.0));
    assert!(interval("sin(180 deg)").contains(0.0) && interval("cos(60 deg)").contains(0.5));
    assert!(interval("sin(pi)").width() > 0.0);
}

#[test]
fn an_interval_with_a_pole_has_no_value() {
    let around_zero = Interval::around(0.0, 1.0);
    for text in ["1/t", "sqrt(t)", "ln(t)", "t^0.5"] {
        assert!(interval_at(around_zero, text).is_err(), "{text}");
    }
    assert_eq!(interval_at(around_zero, "t^2").ok(), Interval::new(0.0, 1.0));
}
