//! Mechanisms in code: they are those of model files, with the same faults.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::drawing::Quantity;
use slideway::report::Proof;
use slideway::{Drawing, GROUND, Model, Settings, gallery, solve};

fn gallery_model(name: &str) -> Model {
    Model::parse(gallery::find(name).unwrap().text).unwrap()
}

/// A bar in two slots, as in the paper.
fn paper() -> (Drawing, [slideway::ids::ContactId; 3]) {
    let mut d = Drawing::new();
    d.gravity("g").parameter("g", "9.81 m/s^2").parameter("m", "1 kg").parameter("l", "1 m");
    d.parameter("alpha", "80 deg").parameter("b", "0.1 m");
    let bar = d.body("bar").mass("m").bar([["0", "0"], ["l*cos(alpha)", "l*sin(alpha)"]]).id();
    let block = d.body("lower_block").massless().id();
    d.hinge("A", bar, block).at([0, 0]);
    let lower = d
        .block_slider("lower", block, GROUND)
        .at([0, 0])
        .length("2*b")
        .height("b")
        .mu(0.1)
        .front(|front| {
            front.preload("m*g");
        })
        .id();
    let upper = d.pin_in_slot("upper", bar, GROUND).at(["l*cos(alpha)", "l*sin(alpha)"]).mu(0.5).id();
    d.slide("q", lower).rate(1);
    (d, [lower.front(), lower.rear(), upper.contact()])
}

#[test]
fn handles_find_what_belongs_to_them() {
    let (drawing, [front, rear, upper]) = paper();
    let answer = solve(&drawing.build().unwrap()).unwrap();
    assert_eq!(answer.complete, Proof::Proven);
    for solution in &answer.solutions {
        let names = [front, rear, upper].map(|contact| solution.contact(contact).name.as_str());
        assert_eq!(names, ["lower.front", "lower.rear", "upper"]);
    }
}

/// Names of points and numbers of contacts go on where they were.
#[test]
fn a_drawing_that_was_stored_is_continued() {
    let (mut drawing, [_, _, upper]) = paper();
    let mut stored: Drawing = serde_json::from_str(&serde_json::to_string(&drawing).unwrap()).unwrap();
    let mut slots = Vec::new();
    for drawing in [&mut drawing, &mut stored] {
        let bar = slideway::ids::BodyId(0);
        slots.push(drawing.pin_in_slot("upper_2", bar, GROUND).at([0, 0]).mu(0.5).id().contact());
        drawing.force("A", bar).at([0, 0]).components([1, 0]);
    }
    assert_eq!(stored.to_toml(), drawing.to_toml());
    assert!(stored.to_toml().contains("A_2"), "a point has the name of the hinge already");
    assert_eq!((slots[0], slots[1].index()), (slots[1], upper.index() + 1));
}

/// A drawer as in the gallery, with everything that its file has but words and shape.
#[test]
fn a_drawing_is_its_model_file() {
    let mut d = Drawing::new();
    for (name, value) in [("L", "0.4 m"), ("a", "0.3 m"), ("Q", "20 N"), ("m", "5 kg")] {
        d.parameter(name, value);
    }
    d.parameter("mu", 0.3);
    let drawer = d.body("drawer").mass("m").centre([0.0, 0.0]).rectangle(["0.45 m", "0.7 m"]).id();
    let guide = d
        .block_slider("guide", drawer, GROUND)
        .at([0.0, 0.0])
        .along("0 deg")
        .length("L")
        .mu("mu")
        .rear(|rear| {
            rear.carried_by_guide();
        })
        .id();
    d.force("resistance", drawer).at([0.0, 0.0]).components(["-Q", "0 N"]);
    let x = d.slide("x", guide).rate("0.1 m/s").id();
    let handle = [Quantity::from("-L/2"), Quantity::from("a")];
    let push = d.drive_by_force("push", x, (drawer, handle, "0 deg")).acceleration(0).id();
    let model = d.build().unwrap();
    for mu in ["0.1", "0.3", "0.7"] {
        let at =
            |model: &Model| solve(&model.with(&Settings::default().parameter("mu", mu)).unwrap()).unwrap();
        let (drawn, filed) = (at(&model), at(&gallery_model("drawer")));
        assert_eq!(drawn.status, filed.status, "{mu}");
        for (one, other) in drawn.solutions.iter().zip(&filed.solutions) {
            assert_eq!(one.pattern, other.pattern);
            assert_eq!(one.contact(guide.front()), other.contact(guide.front()));
            assert_eq!(one.contact(guide.rear()), other.contact(guide.rear()));
            assert_eq!(one.drive(push), other.drive(push));
            assert_eq!(one.coordinate(x), other.coordinate(x));
            assert_eq!(one.body(drawer), other.body(drawer));
        }
    }
}

#[test]
fn faults_are_those_of_a_file() {
    let mut d = Drawing::new();
    let sledge = d.body("sledge").mass("2 m").centre([f64::NAN, 0.0]).id();
    let track = d.block_slider("track", sledge, GROUND).at([0.0, 0.0]).mu(-0.1).id();
    d.slide("x", track);
    let told = d.build().unwrap_err().to_string();
    for fault in ["length", "-0.1", "mass"] {
        assert!(told.contains(fault), "{told}");
    }
    assert_eq!(told, Model::parse(&d.to_toml()).unwrap_err().to_string());
}

#[test]
fn names_are_written_as_they_are_and_judged_by_the_model() {
    let mut d = Drawing::new();
    let odd = d.body("a \"sledge\"\n\\").mass(1).inertia(1).centre([0, 0]).id();
    d.block_slider("track", odd, GROUND).at([0, 0]).length(1).mu(0.1);
    let told = d.build().unwrap_err().to_string();
    assert!(told.contains("sledge"), "{told}");
    let mut twice = Drawing::new();
    for _ in 0..2 {
        let _ = twice.body("sledge").mass(1).inertia(1).centre([0, 0]);
    }
    assert!(twice.build().unwrap_err().to_string().contains("duplicate"));
}

#[test]
fn a_handle_of_another_drawing_is_refused() {
    let mut other = Drawing::new();
    let _ = other.body("first").massless().id();
    let second = other.body("second").massless().id();
    let mut d = Drawing::new();
    let sledge = d.body("sledge").mass(1).inertia(1).centre([0, 0]).id();
    let track = d.block_slider("track", sledge, GROUND).at([0, 0]).length(1).mu(0.1).id();
    d.slide("x", track);
    d.force("push", second).at([0, 0]).components([1, 0]);
    assert!(d.build().unwrap_err().to_string().contains("another drawing"));
}

#[test]
fn points_of_the_same_name_are_told_apart() {
    let mut d = Drawing::new();
    let sledge = d.body("sledge").mass(1).inertia(1).centre([0.0, 0.0]).id();
    let track = d.block_slider("track", sledge, GROUND).at([0.0, 0.0]).length(1.0).mu(0.0).id();
    d.spring("both", [(sledge.into(), [0.0, 0.0]), (GROUND, [-1.0, 0.0])], 10.0).free_length(0.5);
    d.damper("damper", [(sledge.into(), [0.0, 0.0]), (GROUND, [-1.0, 0.0])], 2.0);
    let x = d.slide("x", track).rate(0.5).id();
    let answer = solve(&d.build().unwrap()).unwrap();
    // The spring is stretched by 0.5 m, the damper by 0.5 m/s.
    assert!((answer.solutions[0].coordinate(x).acceleration + 6.0).abs() < 1e-12);
}

/// A sledge that is drawn as a wedge, its top corner `height` above the track.
fn outlined(height: &str) -> Drawing {
    let mut d = Drawing::new();
    d.parameter("h", height);
    let sledge = d.body("sledge").mass(2).centre([0, 0]).inertia(0.1).outline([
        ["0 m", "0 m"],
        ["40 cm", "0 m"],
        ["0 m", "h"],
    ]);
    let sledge = sledge.id();
    let track = d.block_slider("track", sledge, GROUND).at([0, 0]).length("20 cm").mu(0.2).id();
    d.force("pull", sledge).at(["0 m", "5 cm"]).components([10, 0]);
    d.slide("x", track).rate(1);
    d
}

#[test]
fn an_outline_is_for_looks_only() {
    use nalgebra::Vector2;
    use slideway::mechanism::Mechanism;
    let model = outlined("10 cm").build().unwrap();
    let mechanism = Mechanism::new(&model).unwrap();
    let corners = [Vector2::new(0.0, 0.0), Vector2::new(0.4, 0.0), Vector2::new(0.0, 0.1)];
    assert_eq!(slideway::model::outline::polygon(&mechanism.bodies[0].outline), corners);
    // Forces, accelerations and the unit of length of the mechanism are those of any other outline.
    let huge = outlined("10 km").build().unwrap();
    assert_eq!(Mechanism::new(&huge).unwrap().size, mechanism.size);
    assert_eq!(solve(&huge).unwrap().solutions, solve(&model).unwrap().solutions);
}

#[test]
fn an_outline_is_checked() {
    let told = |drawing: &Drawing| drawing.build().unwrap_err().to_string();
    assert!(told(&outlined("2 kg")).contains("a mass where a length is expected"));
    assert!(told(&outlined("1 m/0")).contains("division by zero"));
    let mut line = Drawing::new();
    line.body("sledge").massless().outline([[0, 0], [1, 0]]);
    let two = told(&line);
    assert!(two.contains("`bodies.sledge.outline` must have at least 3 values, not 2"), "{two}");
}

/// A corner that is a named point is that point: limits over a parameter that moves it are those of the model
/// without outline, whose margin is not linear in the parameter. Small corners raise no doubt about units.
#[test]
fn a_named_corner_is_its_point() {
    use slideway::Report;
    use slideway::limits::{LimitsOptions, Vary, limits};
    let text = gallery::find("drawer").unwrap().text;
    let corners = "outline = [[0, \"a\"], \"handle\", [\"0.001 um\", \"-a\"]]\n";
    let outlined = text.replace("[bodies.drawer]\n", &format!("[bodies.drawer]\n{corners}"));
    assert_ne!(outlined, text);
    let answers = [text, &outlined].map(|text| {
        let model = Model::parse(text).unwrap();
        let doubts = slideway::warning::warnings(&model).to_string();
        let over = |name: &str, from: &str, to: &str| {
            limits(&model, &LimitsOptions::new(Vary::between(name, from, to))).unwrap().json()
        };
        (over("a", "0.1 m", "0.4 m"), over("L", "0.2 m", "0.5 m"), over("mu", "0", "1"), doubts)
    });
    assert_eq!(answers[0], answers[1]);
}

/// A block of 5 kg under 20 m/s^2 on a floor of its own length: p = 100 N / (0.2 m 0.05 m).
#[test]
fn pads_give_bearing_pressures() {
    use slideway::report::{Report, Style};
    let guided = |pad: &str| {
        let text = format!(
            r#"
            gravity = "20 m/s^2"
            [bodies.block]
            mass = "5 kg"
            centre_of_mass = [0, 0]
            shape = {{ disc = "0.1 m" }}
            [joints.floor]
            type = "guided_slider"
            block = "block"
            at = [0, 0]
            along = "0 deg"
            length = "0.2 m"
            mu = 0.1
            {pad}
            [coordinates.x]
            slide = "floor"
            rate = "1 m/s"
            "#
        );
        solve(&Model::parse(&text).unwrap()).unwrap()
    };
    let pressure = |pad: &str| guided(pad).solutions[0].contacts[0].pressure;
    let close = |found: Option<f64>, expected: f64| {
        assert!((found.unwrap() / expected - 1.0).abs() < 1e-13, "{found:?} instead of {expected}");
    };
    close(pressure(r#"pad = { width = "50 mm" }"#), 1e4);
    close(pressure(r#"pad = { length = "40 mm", width = "50 mm" }"#), 5e4);
    assert_eq!(pressure(""), None);

    let [without, with] = ["", r#"pad = { width = "50 mm" }"#].map(guided);
    assert!(!without.text(Style::PLAIN).contains("pressure in"));
    assert!(with.text(Style::PLAIN).contains("pressure in Pa"), "{}", with.text(Style::PLAIN));
    assert!(!without.csv().contains(",pressure,"));
    assert!(with.csv().contains(",contact,floor,pressure,10000,Pa\n"), "{}", with.csv());
    assert!(with.json().contains(r#""pressure": 10000.0"#), "{}", with.json());
}

/// That of one end takes precedence, and the builder writes what the file has.
#[test]
fn pads_of_one_end_take_precedence() {
    let mut d = Drawing::new();
    d.gravity("20 m/s^2").parameter("w", "50 mm");
    let block = d.body("block").mass("5 kg").centre([0.0, 0.0]).rectangle(["0.2 m", "0.1 m"]).id();
    let slider = d.block_slider("rail", block, GROUND).at([0, 0]).length("0.2 m").mu(0.0);
    let rail = slider
        .pad(["20 mm", "w"])
        .rear(|rear| {
            rear.pad(["10 mm", "w"]);
        })
        .id();
    d.slide("x", rail).rate("1 m/s");
    let report = solve(&d.build().unwrap()).unwrap();
    // 50 N at each end.
    for (contact, expected) in [(rail.front(), 5e4), (rail.rear(), 1e5)] {
        let found = report.solutions[0].contact(contact).pressure.unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} instead of {expected}");
    }
}

/// A bar on three pads as the builder writes it, and as a file has it: the same answer. The third pad counts among the
/// contacts, so that handles of later joints are theirs.
#[test]
fn guides_that_share_a_load() {
    let text = r#"
        [bodies.bar]
        mass = 5
        moment_of_inertia = 0.2
        centre_of_mass = [0, 0]
        [points]
        handle = ["0.35 m", "0.1 m"]
        [joints.guide]
        type = "block_slider"
        block = "bar"
        at = [0, 0]
        along = 0
        length = "600 mm"
        mu = 0.2
        play = "0.2 mm"
        stiffness = "1e5 N/m"
        rear = { misalignment = "-0.05 mm" }
        supports = { middle = { at = "60 mm", misalignment = "0.1 mm", play = "0.3 mm" } }
        [loads.side]
        type = "force"
        at = "bar.handle"
        components = ["30 N", "-40 N"]
        [coordinates.s]
        slide = "guide"
        rate = 0.3
    "#
    .replace("[bodies.bar]", "[bodies.bar]\n        points = [\"handle\"]");
    let mut d = Drawing::new();
    let bar = d.body("bar").mass(5).inertia(0.2).centre([0, 0]).id();
    let guide = d
        .block_slider("guide", bar, GROUND)
        .at([0, 0])
        .length("600 mm")
        .mu(0.2)
        .play("0.2 mm")
        .stiffness("1e5 N/m")
        .rear(|rear| {
            rear.misalignment("-0.05 mm");
        })
        .support("middle", "6 cm", |_| {})
        .support("middle", "60 mm", |middle| {
            middle.misalignment("0.1 mm").play("0.3 mm");
        })
        .id();
    let nut = d.body("nut").mass(1).centre([1, 0]).inertia(0.1).id();
    let track = d.block_slider("track", nut, GROUND).at([1.0, 0.0]).length(1.0).mu(0.1).id();
    d.force("side", bar).at([0.35, 0.1]).components(["30 N", "-40 N"]);
    d.slide("s", guide).rate(0.3);
    d.slide("u", track).rate(0.1);
    let built = solve(&d.build().unwrap()).unwrap();
    let read = solve(&Model::parse(&text).unwrap()).unwrap();
    let [built, read] = [&built, &read].map(|report| {
        let [solution] = &report.solutions[..] else { panic!("one solution") };
        solution.clone()
    });
    assert_eq!(read.contacts.len(), 3);
    for (one, other) in built.contacts.iter().zip(&read.contacts) {
        assert_eq!(one.name, other.name);
        assert!((one.normal_force - other.normal_force).abs() < 1e-9, "{one:?} {other:?}");
        let [one, other] = [one, other].map(|contact| contact.deflection.unwrap());
        assert!((one - other).abs() < 1e-15, "{one} {other}");
    }
    assert_eq!(built.contact(guide.rear()).name, "guide.rear");
    assert_eq!(built.contact(track.front()).name, "track.front");
}

/// A solid disc that rolls down an incline: `x'' = 2/3 g sin(slope)`, with no coordinate but that of its centre.
#[test]
fn a_disc_that_is_said_to_stick_rolls() {
    let mut d = Drawing::new();
    d.gravity("9.81 m/s^2").parameter("slope", "20 deg");
    let wheel = d.body("wheel").mass("2 kg").centre([0, 0]).disc("0.1 m").id();
    let foot =
        d.disc_on_face("foot", wheel, GROUND).at([0, 0]).radius("0.1 m").along("slope").mu(0.5).sticks().id();
    d.slide("x", foot);
    let answer = solve(&d.build().unwrap()).unwrap();
    let expected = -2.0 / 3.0 * 9.81 * 20_f64.to_radians().sin();
    assert!((answer.solutions[0].coordinates[0].acceleration - expected).abs() < 1e-12, "{answer:#?}");
}

/// The other end of a rod on a floor is 0.2 m above that.
#[test]
fn a_corner_is_apart_from_a_face_with_ends() {
    let mut d = Drawing::new();
    d.gravity("9.81 m/s^2");
    let rod = d.body("rod").mass("1 kg").bar([[0.0, 0.0], [1.0, 0.2]]).id();
    let tip = d.corner_on_face("tip", rod, GROUND).at([0.0, 0.0]).mu(0).id();
    d.corner_on_face("end", rod, GROUND).at([1.0, 0.2]).face([[-2.0, 0.0], [2.0, 0.0]]).mu(0.3).apart();
    d.slide("x", tip).rate(1);
    d.rotation("turn", rod);
    let model = d.build().unwrap();
    let answer = solve(&model).unwrap();
    assert_eq!((answer.complete, answer.solutions[0].contacts.len()), (Proof::Proven, 1));
    let mechanism = slideway::mechanism::Mechanism::new(&model).unwrap();
    let (_, slider) = mechanism.sliders().nth(1).unwrap();
    assert!((slider.apart[0].gap - 0.2).abs() < 1e-15, "{slider:?}");
}
