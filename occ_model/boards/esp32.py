"""Sketches for the ESP32, whose remote-control peripheral (RMT) sends levels of given lengths.

The transmission is endless: a function fills one half of the peripheral's memory while the other
half is sent. It uses ``driver/rmt_tx.h`` and ``driver/rmt_encoder.h`` of ESP-IDF 5.3, which are in
the Arduino core 3.1 for the ESP32.
"""

from string import Template

from occ_model.boards.board import TransmitterBoard
from occ_model.boards.chip_table import c_table, head_comment
from occ_model.boards.transmission import Transmission

_CLOCK = 80_000_000

ESP32 = TransmitterBoard(
    name="esp32",
    title="ESP32",
    clock=_CLOCK,
    # The modules have crystals with 10 ppm.
    clock_error=10.0,
    # The driver needs a resolution in whole Hz.
    prescalers=tuple(number for number in range(1, 257) if _CLOCK % number == 0),
    # A duration has 15 bits.
    largest_count=32_767,
    least_cycles=80,
    limit_reason=(
        "the 64 chips that are refilled at a time would then last less than 64 µs (an estimate, "
        "not measured)"
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

_SKETCH = Template("""\
$head
//
// Needs the Arduino core for the ESP32, version 3.1 or later.

#include <stddef.h>
#include <stdint.h>

#include "driver/rmt_encoder.h"
#include "driver/rmt_tx.h"

// The packet, eight chips to a byte: the first chip is the highest bit of the first byte, and a 1
// is light.
const uint32_t CHIPS = $chips;
const uint8_t PACKET[] = {
$table
};

// The peripheral RMT counts ticks of its clock, and a chip lasts so many of them.
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
  ESP_ERROR_CHECK(rmt_transmit(channel, encoder, PACKET, sizeof(PACKET), &sendOnce));
}

void loop() {}
""")


def esp32_sketch(sent: Transmission) -> str:
    """Write the sketch in C++ for the Arduino IDE with the core for the ESP32."""
    timing = sent.timing
    return _SKETCH.substitute(
        head=head_comment(sent, "//"),
        chips=len(sent.chips),
        table=c_table(sent.chips),
        resolution=timing.clock // timing.prescaler,
        prescaler=timing.prescaler,
        count=timing.count,
    )
