/* What a sketch for the ESP32 uses of ESP-IDF, standing in for it: the transmission is asked for
 * its symbols as the driver would, half of the memory at a time, and they are printed. */
#pragma once
#include <stdio.h>
#include <stdlib.h>

typedef int esp_err_t;
#define ESP_ERROR_CHECK(result) do { if ((result) != 0) abort(); } while (0)
enum gpio_num_t { GPIO_NUM_NONE, GPIO_NUM_4 = 4 };
enum rmt_clock_source_t { RMT_CLK_SRC_NONE, RMT_CLK_SRC_APB };

typedef union {
    struct {
        unsigned short duration0 : 15, level0 : 1, duration1 : 15, level1 : 1;
    };
    unsigned int val;
} rmt_symbol_word_t;

typedef size_t (*rmt_encode_simple_cb_t)(const void *, size_t, size_t, size_t, rmt_symbol_word_t *,
                                         bool *, void *);
typedef struct {
    rmt_encode_simple_cb_t callback;
    void *arg;
    size_t min_chunk_size;
} rmt_simple_encoder_config_t;
typedef struct {
    gpio_num_t gpio_num;
    rmt_clock_source_t clk_src;
    unsigned int resolution_hz;
    size_t mem_block_symbols, trans_queue_depth;
} rmt_tx_channel_config_t;
typedef struct {
    int loop_count;
} rmt_transmit_config_t;
typedef struct rmt_channel_t { rmt_tx_channel_config_t settings; bool enabled; } *rmt_channel_handle_t;
typedef rmt_simple_encoder_config_t *rmt_encoder_handle_t;

inline esp_err_t rmt_new_tx_channel(const rmt_tx_channel_config_t *settings,
                                    rmt_channel_handle_t *channel)
{
    *channel = new rmt_channel_t{*settings, false};
    return settings->gpio_num != GPIO_NUM_4 || settings->clk_src != RMT_CLK_SRC_APB;
}

inline esp_err_t rmt_new_simple_encoder(const rmt_simple_encoder_config_t *settings,
                                        rmt_encoder_handle_t *encoder)
{
    *encoder = new rmt_simple_encoder_config_t(*settings);
    return 0;
}

inline esp_err_t rmt_enable(rmt_channel_handle_t channel)
{
    channel->enabled = true;
    return 0;
}

inline esp_err_t rmt_transmit(rmt_channel_handle_t channel, rmt_encoder_handle_t encoder,
                              const void *data, size_t size, const rmt_transmit_config_t *settings)
{
    if (!channel->enabled || size == 0 || settings->loop_count != 0)
        return 1;
    printf("%u\n", channel->settings.resolution_hz);
    rmt_symbol_word_t memory[64];
    size_t written = 0;
    while (written < TEST_SYMBOLS) {
        const size_t room = written ? channel->settings.mem_block_symbols / 2
                                    : channel->settings.mem_block_symbols;
        bool done = false;
        const size_t made = encoder->callback(data, size, written, room, memory, &done, encoder->arg);
        if (done || made == 0 || made > room)
            return 2;
        for (size_t place = 0; place < made; ++place) {
            printf("%u %u\n", memory[place].level0, memory[place].duration0);
            printf("%u %u\n", memory[place].level1, memory[place].duration1);
        }
        written += made;
    }
    return 0;
}
