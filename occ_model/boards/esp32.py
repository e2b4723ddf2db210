"""Sketches for the ESP32, whose remote-control peripheral (RMT) sends levels of given lengths.

The transmission is endless: a function fills one half of the peripheral's memory while the other
half is sent. It uses ``driver/rmt_tx.h`` and ``driver/rmt_encoder.h`` of ESP-IDF 5.3, which are in
the Arduino core 3.1 for the ESP32. Lamps are sent in the same way, because the ESP32's LED
controller divides the clock by fractions, which moves single edges, and counts to powers of two.
"""

from string import Template

from occ_model.boards.board import Timer, TransmitterBoard
from occ_model.boards.chip_table import c_table, head_comment
from occ_model.boards.transmission import LampTransmission, Transmission

_CLOCK = 80_000_000

ESP32 = TransmitterBoard(
    name="esp32",
    title="ESP32",
    clock=_CLOCK,
    # The modules have crystals with 10 ppm.
    clock_error=10.0,
    chip_timer=Timer(
        # The driver needs a resolution in whole Hz.
        prescalers=tuple(number for number in range(1, 257) if _CLOCK % number == 0),
        least_count=80,
        # A duration has 15 bits.
        largest_count=32_767,
        limit_reason=(
            "the 64 chips that are refilled at a time would then last less than 64 µs (an "
            "estimate, not measured)"
        ),
    ),
    # A period of 32 bits takes several symbols if necessary. Its parts last longer than 8 cycles,
    # below which the peripheral of newer chips does not work (their manuals: 3 + 5 cycles).
    lamp_timer=Timer(
        prescalers=(1,),
        least_count=160,
        largest_count=2**32 - 1,
        least_part=9,
        limit_reason=(
            "the 32 periods that are refilled at a time would then last less than 64 µs (an "
            "estimate, not measured)"
        ),
    ),
    pin="GPIO 4",
    ground="GND",
    volts=3.3,
    pin_current=0.020,
    gate_resistor=180,
    led_resistor=150,
    transistor="AO3400A",
    table_bytes=65_536,
    language="C++",
    ending=".ino",
)

_INCLUDES = """\
$head
//
// Needs the Arduino core for the ESP32, version 3.1 or later.

#include <stddef.h>
#include <stdint.h>

#include "driver/rmt_encoder.h"
#include "driver/rmt_tx.h"

"""

_CHIP_SYMBOLS = """\
// The packet, eight chips to a byte: the first chip is the highest bit of the first byte, and a 1
// is light.
const uint32_t CHIPS = $chips;
const uint8_t PACKET[] = {
$table
};

// The RMT peripheral counts ticks of its clock; a chip lasts TICKS_PER_CHIP of them.
const uint32_t TICKS_PER_SECOND = $resolution;  // 80 MHz / $prescaler
const uint16_t TICKS_PER_CHIP = $count;

static bool isLit(uint32_t chip) { return PACKET[chip / 8] & (0x80 >> chip % 8); }

// RMT asks for the next symbols whenever half of its memory is sent. A symbol is two levels, each
// with its length: here two chips. The packet is endless, so this never says that it is done.
static size_t nextSymbols(const void *, size_t, size_t, size_t room, rmt_symbol_word_t *symbols,
                          bool *, void *) {
  static uint32_t chip = 0;
  for (size_t place = 0; place < room; ++place) {
    symbols[place].duration0 = TICKS_PER_CHIP;
    symbols[place].level0 = isLit(chip);
    if (++chip == CHIPS) chip = 0;
    symbols[place].duration1 = TICKS_PER_CHIP;
    symbols[place].level1 = isLit(chip);
    if (++chip == CHIPS) chip = 0;
  }
  return room;
}

"""

_LAMP_SYMBOLS = """\
// The lamp is lit, then dark, for these numbers of ticks of the peripheral's clock.
const uint32_t TICKS_PER_SECOND = $resolution;
const uint32_t PARTS[] = {$lit, $dark};

// RMT asks for the next symbols whenever half of its memory is sent. A symbol is two levels, each
// with its length of 15 bits: a longer part of the period takes several. It is never done.
static uint16_t nextTicks(uint16_t *level) {
  static uint8_t part = 0;
  static uint32_t left = PARTS[0];
  const uint16_t ticks = left > 0x7FFF ? 0x4000 : left;
  *level = part == 0;
  left -= ticks;
  if (left == 0) left = PARTS[part = 1 - part];
  return ticks;
}

static size_t nextSymbols(const void *, size_t, size_t, size_t room, rmt_symbol_word_t *symbols,
                          bool *, void *) {
  for (size_t place = 0; place < room; ++place) {
    uint16_t level;
    symbols[place].duration0 = nextTicks(&level);
    symbols[place].level0 = level;
    symbols[place].duration1 = nextTicks(&level);
    symbols[place].level1 = level;
  }
  return room;
}

"""

_SETUP = """\
void setup() {
  rmt_tx_channel_config_t channelSettings = {};
  channelSettings.gpio_num = GPIO_NUM_4;
  channelSettings.clk_src = RMT_CLK_SRC_APB;  // 80 MHz
  channelSettings.resolution_hz = TICKS_PER_SECOND;
  channelSettings.mem_block_symbols = 64;
  channelSettings.trans_queue_depth = 1;
  rmt_channel_handle_t channel = NULL;
  ESP_ERROR_CHECK(rmt_new_tx_channel(&channelSettings, &channel));

  rmt_simple_encoder_config_t encoderSettings = {};
  encoderSettings.callback = nextSymbols;
  rmt_encoder_handle_t encoder = NULL;
  ESP_ERROR_CHECK(rmt_new_simple_encoder(&encoderSettings, &encoder));

  ESP_ERROR_CHECK(rmt_enable(channel));
  rmt_transmit_config_t sendOnce = {};  // one transmission, which has no end
  ESP_ERROR_CHECK(rmt_transmit(channel, encoder, $data, sizeof($data), &sendOnce));
}

void loop() {}
"""


def esp32_sketch(transmission: Transmission) -> str:
    """Write the sketch in C++ for the Arduino IDE with the core for the ESP32."""
    timing = transmission.timing
    words: dict[str, object] = {
        "head": head_comment(transmission, "//"),
        "resolution": timing.clock // timing.prescaler,
    }
    if isinstance(transmission, LampTransmission):
        lit = transmission.timing.lit_count
        words |= {"lit": lit, "dark": timing.count - lit, "data": "PARTS"}
        return Template(_INCLUDES + _LAMP_SYMBOLS + _SETUP).substitute(words)
    return Template(_INCLUDES + _CHIP_SYMBOLS + _SETUP).substitute(
        words,
        chips=len(transmission.chips),
        table=c_table(transmission.chips),
        prescaler=timing.prescaler,
        count=timing.count,
        data="PACKET",
    )
