//! Law: the tracer meets the surface that a naive loop over the triangles of the scene meets.
#![cfg(feature = "ilv")]

mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use steradian::glam::{DVec3, dvec3};
use tracer::{Scene, bounds, random_direction, random_point};

/// A triangle with a name for what it belongs to.
struct Triangle {
    corners: [DVec3; 3],
    part: &'static str,
}

fn polygon(list: &mut Vec<Triangle>, part: &'static str, corners: &[DVec3]) {
    for i in 1..corners.len() - 1 {
        list.push(Triangle { corners: [corners[0], corners[i], corners[i + 1]], part });
    }
}

/// The quadrilateral between two opposite corners that agree in one coordinate.
fn quad(list: &mut Vec<Triangle>, part: &'static str, a: DVec3, b: DVec3) {
    let corners = if a.x == b.x {
        [a, dvec3(a.x, b.y, a.z), b, dvec3(a.x, a.y, b.z)]
    } else if a.y == b.y {
        [a, dvec3(b.x, a.y, a.z), b, dvec3(a.x, a.y, b.z)]
    } else {
        [a, dvec3(b.x, a.y, a.z), b, dvec3(a.x, b.y, a.z)]
    };
    polygon(list, part, &corners);
}

fn block(list: &mut Vec<Triangle>, part: &'static str, base: [(f64, f64); 4], height: f64) {
    polygon(list, part, &base.map(|(x, z)| dvec3(x, height, z)));
    for i in 0..4 {
        let ((x, z), (next_x, next_z)) = (base[i], base[(i + 1) % 4]);
        let side = [dvec3(x, 0.0, z), dvec3(next_x, 0.0, next_z), dvec3(next_x, height, next_z), dvec3(x, height, z)];
        polygon(list, part, &side);
    }
}

fn cornell(closed: bool) -> Vec<Triangle> {
    let mut list = Vec::new();
    let (width, height, depth) = (556.0, 548.8, 559.2);
    quad(&mut list, "white", DVec3::ZERO, dvec3(width, 0.0, depth));
    quad(&mut list, "white", dvec3(0.0, height, 0.0), dvec3(width, height, depth));
    quad(&mut list, "white", dvec3(0.0, 0.0, depth), dvec3(width, height, depth));
    quad(&mut list, "green", DVec3::ZERO, dvec3(0.0, height, depth));
    quad(&mut list, "red", dvec3(width, 0.0, 0.0), dvec3(width, height, depth));
    if closed {
        quad(&mut list, "white", DVec3::ZERO, dvec3(width, height, 0.0));
    }
    block(&mut list, "white", [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)], 165.0);
    block(&mut list, "white", [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)], 330.0);
    quad(&mut list, "light", dvec3(213.0, 548.3, 227.0), dvec3(343.0, 548.3, 332.0));
    list
}

fn corridor() -> Vec<Triangle> {
    let mut list = Vec::new();
    let height = 2.5;
    for (part, y) in [("floor", 0.0), ("wall", height)] {
        quad(&mut list, part, dvec3(0.0, y, 0.0), dvec3(2.0, y, 6.0));
        quad(&mut list, part, dvec3(2.0, y, 4.0), dvec3(6.0, y, 6.0));
    }
    let walls = [
        [(0.0, 0.0), (0.0, 6.0)],
        [(0.0, 0.0), (2.0, 0.0)],
        [(2.0, 0.0), (2.0, 4.0)],
        [(2.0, 4.0), (6.0, 4.0)],
        [(6.0, 4.0), (6.0, 6.0)],
        [(0.0, 6.0), (6.0, 6.0)],
    ];
    for [(x, z), (next_x, next_z)] in walls {
        quad(&mut list, "wall", dvec3(x, 0.0, z), dvec3(next_x, height, next_z));
    }
    block(&mut list, "cube", [(0.6, 4.0), (1.2, 4.0), (1.2, 4.6), (0.6, 4.6)], 0.6);
    quad(&mut list, "light", dvec3(5.98, 0.75, 4.5), dvec3(5.98, 1.75, 5.5));
    list
}

fn reflectance(part: &str) -> DVec3 {
    match part {
        "white" => dvec3(0.725, 0.71, 0.68),
        "red" => dvec3(0.63, 0.065, 0.05),
        "green" => dvec3(0.14, 0.45, 0.091),
        "floor" => dvec3(0.5, 0.45, 0.4),
        "wall" => dvec3(0.75, 0.75, 0.72),
        "cube" => dvec3(0.65, 0.06, 0.05),
        "light" => DVec3::ZERO,
        _ => unreachable!("no part is called {part}"),
    }
}

/// Distance, and how far inside the triangle in barycentric coordinates; Möller and Trumbore (1997).
fn meet(triangle: &Triangle, origin: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let [a, b, c] = triangle.corners;
    let (first, second, start) = (b - a, c - a, origin - a);
    let pivot = direction.cross(second);
    let determinant = first.dot(pivot);
    let u = start.dot(pivot) / determinant;
    let v = direction.dot(start.cross(first)) / determinant;
    let distance = second.dot(start.cross(first)) / determinant;
    let inside = u.min(v).min(1.0 - u - v);
    (inside >= 0.0 && distance > 0.0).then_some((distance, inside))
}

#[test]
fn first_hits_are_those_of_triangles() {
    let scenes =
        [(Scene::cornell(), cornell(false)), (Scene::cornell_closed(), cornell(true)), (Scene::corridor(), corridor())];
    for (stream, (scene, triangles)) in scenes.into_iter().enumerate() {
        let mut rng = seeds::rng(0x100 + stream as u64);
        let (mut compared, mut met) = (0_u32, std::collections::BTreeSet::new());
        for _ in 0..seeds::cases(100_000) {
            let (origin, direction) = (random_point(&scene, &mut rng), random_direction(&mut rng));
            let mut hits: Vec<_> = triangles
                .iter()
                .filter_map(|triangle| meet(triangle, origin, direction).map(|(t, inside)| (t, inside, triangle.part)))
                .collect();
            hits.sort_by(|a, b| a.0.total_cmp(&b.0));
            let Some(&(distance, inside, part)) = hits.first() else {
                let hit = scene.intersect(origin, direction);
                assert!(hit.is_none(), "{}: {origin} along {direction} should miss, got {hit:?}", scene.name);
                continue;
            };
            // Where two triangles meet, or two hits almost coincide, rounding may choose either.
            let tie = hits.get(1).is_some_and(|next| next.0 - distance < bounds::TIE * scene.size);
            if inside < bounds::TIE || tie || distance < bounds::TIE * scene.size {
                continue;
            }
            compared += 1;
            met.insert(part);
            let hit = scene.intersect(origin, direction);
            let hit = hit.unwrap_or_else(|| panic!("{}: {origin} along {direction} should meet {part}", scene.name));
            assert_eq!(
                hit.reflectance,
                reflectance(part),
                "{}: {origin} along {direction} should meet {part} at {distance}, got {hit:?}",
                scene.name
            );
            // A plane met at a small angle magnifies the rounding of the points.
            let bound = bounds::DISTANCE * scene.size / hit.normal.dot(direction).abs();
            let error = (hit.distance - distance).abs().max((hit.position - origin - direction * distance).length());
            assert!(error <= bound, "{}: got {hit:?}, want distance {distance}, bound {bound:e}", scene.name);
        }
        let parts: std::collections::BTreeSet<_> = triangles.iter().map(|triangle| triangle.part).collect();
        assert_eq!(met, parts, "{}: parts met", scene.name);
        assert!(compared >= seeds::cases(90_000), "{}: only {compared} rays could be compared", scene.name);
    }
}
