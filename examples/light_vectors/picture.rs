//! Pictures: tone-mapped radiance, error maps with their scale, and one sheet with all of them.

use std::path::Path;

use embedded_graphics::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    mono_font::{MonoTextStyle, ascii::FONT_8X13},
    pixelcolor::Rgb888,
    prelude::{Drawable, RgbColor, WebColors},
    text::{Alignment, Text},
};
use image::{Rgb, RgbImage, imageops};
use steradian::{glam::DVec3, ilv::luminance};

use crate::error::JobError;

/// Error, relative to the mean indirect luminance, at the bright end of the error maps.
pub const LARGEST_ERROR: f64 = 0.3;
const BACKGROUND: Rgb<u8> = Rgb([24, 24, 24]);
const MARGIN: u32 = 12;
const LINE: u32 = 18;
/// Captions and scales need this much room, whatever the size of the pictures.
const NARROWEST: u32 = 200;

/// The factor that brings the 99th percentile of the luminance to 1.
pub fn exposure(radiances: &[DVec3]) -> f64 {
    let mut luminances: Vec<f64> = radiances.iter().map(|&rgb| luminance(rgb)).filter(|&y| y > 0.0).collect();
    luminances.sort_by(f64::total_cmp);
    match luminances.len() {
        0 => 1.0,
        n => 1.0 / luminances[(n * 99) / 100],
    }
}

/// A picture of linear radiances: scaled by `exposure`, compressed, and encoded as sRGB (IEC 61966-2-1).
pub fn tone_mapped(radiances: &[DVec3], size: u32, exposure: f64) -> RgbImage {
    let channel = |x: f64| {
        let compressed = 1.0 - (-1.6 * x * exposure).exp();
        let encoded =
            if compressed <= 0.003_130_8 { 12.92 * compressed } else { 1.055 * compressed.powf(1.0 / 2.4) - 0.055 };
        (255.0 * encoded + 0.5) as u8
    };
    image_of(size, |pixel| {
        let rgb = radiances[pixel];
        Rgb([channel(rgb.x), channel(rgb.y), channel(rgb.z)])
    })
}

/// An error of the luminance, relative to its mean, on the colours of "inferno".
pub fn error_map(size: u32, error: impl Fn(usize) -> f64) -> RgbImage {
    image_of(size, |pixel| inferno(error(pixel).abs() / LARGEST_ERROR))
}

/// An error map with the scale of its colours under it, in parts of the mean.
pub fn with_scale(map: &RgbImage) -> RgbImage {
    let height = map.height();
    let width = map.width().max(NARROWEST);
    let mut sheet = RgbImage::from_pixel(width, height + 3 * LINE, BACKGROUND);
    imageops::replace(&mut sheet, map, 0, 0);
    draw_scale(&mut sheet, MARGIN, height + 4, width - 2 * MARGIN);
    sheet
}

/// One column of the contact sheet.
pub struct Column {
    pub title: String,
    pub note: String,
    pub pictures: [RgbImage; 3],
}

/// Every method beside the others: picture, indirect light, error.
pub fn contact_sheet(title: &str, columns: &[Column]) -> RgbImage {
    let Some(side) = columns.first().map(|column| column.pictures[0].width()) else { return RgbImage::new(1, 1) };
    let pitch = side.max(NARROWEST) + MARGIN;
    let top = MARGIN + 4 * LINE;
    let rows = [("picture", 0), ("indirect light", 1), ("|error| of luminance / its mean", 2)];
    let width = MARGIN + columns.len() as u32 * pitch;
    let height = top + rows.len() as u32 * (side + LINE + MARGIN) + 3 * LINE;
    let mut sheet = RgbImage::from_pixel(width, height, BACKGROUND);
    draw_text(&mut sheet, title, MARGIN, MARGIN, Rgb888::WHITE);
    for (i, column) in columns.iter().enumerate() {
        let x = MARGIN + i as u32 * pitch;
        draw_text(&mut sheet, &column.title, x, MARGIN + LINE + 6, Rgb888::WHITE);
        draw_text(&mut sheet, &column.note, x, MARGIN + 2 * LINE + 6, Rgb888::CSS_SILVER);
        for (caption, row) in rows {
            let y = top + row as u32 * (side + LINE + MARGIN);
            if i == 0 {
                draw_text(&mut sheet, caption, x, y, Rgb888::CSS_SILVER);
            }
            imageops::replace(&mut sheet, &column.pictures[row], i64::from(x), i64::from(y + LINE));
        }
    }
    draw_scale(&mut sheet, MARGIN, height - 3 * LINE, side.max(NARROWEST));
    sheet
}

/// Writes a picture as PNG.
pub fn save(picture: &RgbImage, path: &Path) -> Result<(), JobError> {
    picture.save(path).map_err(|error| JobError::Picture { path: path.to_owned(), error })
}

fn image_of(size: u32, colour: impl Fn(usize) -> Rgb<u8>) -> RgbImage {
    RgbImage::from_fn(size, size, |x, y| colour((y * size + x) as usize))
}

fn inferno(t: f64) -> Rgb<u8> {
    Rgb(colorous::INFERNO.eval_continuous(t.clamp(0.0, 1.0)).as_array())
}

fn draw_scale(sheet: &mut RgbImage, x: u32, y: u32, width: u32) {
    for i in 0..width {
        for j in 0..LINE {
            sheet.put_pixel(x + i, y + j, inferno(f64::from(i) / f64::from(width - 1)));
        }
    }
    let percent = |t: f64| format!("{:.0} %", 100.0 * t * LARGEST_ERROR);
    for (t, alignment) in [(0.0, Alignment::Left), (0.5, Alignment::Center), (1.0, Alignment::Right)] {
        let at = Point::new((x + (t * f64::from(width)) as u32) as i32, (y + LINE + 13) as i32);
        let style = MonoTextStyle::new(&FONT_8X13, Rgb888::CSS_SILVER);
        let label = if t == 1.0 { format!(">= {}", percent(t)) } else { percent(t) };
        let _ = Text::with_alignment(&label, at, style, alignment).draw(&mut Canvas(sheet));
    }
}

fn draw_text(sheet: &mut RgbImage, text: &str, x: u32, y: u32, colour: Rgb888) {
    let style = MonoTextStyle::new(&FONT_8X13, colour);
    // A canvas cannot fail: pixels outside it are left out.
    let _ = Text::new(text, Point::new(x as i32, y as i32 + 11), style).draw(&mut Canvas(sheet));
}

/// An image on which text can be drawn.
struct Canvas<'a>(&'a mut RgbImage);

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb888;
    type Error = std::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(at, colour) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(at.x), u32::try_from(at.y)) else { continue };
            if x < self.0.width() && y < self.0.height() {
                self.0.put_pixel(x, y, Rgb([colour.r(), colour.g(), colour.b()]));
            }
        }
        Ok(())
    }
}
